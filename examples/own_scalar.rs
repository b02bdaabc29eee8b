//! A scalar of one's own: a float that counts the multiplications and divisions that it came from.

use planar_impact::prelude::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Counted {
    value: f64,
    products: u32,
}

impl Counted {
    fn of(value: f64, from: &[Counted], products: u32) -> Self {
        Counted { value, products: products + from.iter().map(|part| part.products).sum::<u32>() }
    }
}

macro_rules! operator {
    ($Trait:ident $method:ident $operator:tt $products:literal) => {
        impl $Trait for Counted {
            type Output = Counted;
            fn $method(self, other: Counted) -> Counted {
                Counted::of(self.value $operator other.value, &[self, other], $products)
            }
        }
    };
}
operator!(Add add + 0);
operator!(Sub sub - 0);
operator!(Mul mul * 1);
operator!(Div div / 1);

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        Counted { value: -self.value, ..self }
    }
}

impl num_traits::Inv for Counted {
    type Output = Counted;
    fn inv(self) -> Counted {
        Counted::of(1.0 / self.value, &[self], 1)
    }
}

impl num_traits::FromPrimitive for Counted {
    fn from_i64(n: i64) -> Option<Counted> {
        Some(Counted { value: n as f64, products: 0 })
    }
    fn from_u64(n: u64) -> Option<Counted> {
        i64::try_from(n).ok().and_then(Counted::from_i64)
    }
}

fn main() -> Result<(), Refusals> {
    let car = Vehicle::new(1200.0, 1900.0).with_impact_center(1.8, 0.3).with_speed(15.0);
    let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    let impact = collision.map(|value| Counted { value, products: 0 }).evaluate();
    assert_eq!(impact.loss().value, collision.solve()?.loss());
    println!("{:?}", impact.loss());
    Ok(())
}
