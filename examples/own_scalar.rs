//! A scalar of one's own: a float that counts the multiplications and divisions that it came from.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use planar_impact::prelude::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Counted(f64, u32);

macro_rules! operator {
    ($Trait:ident $method:ident $operator:tt $products:literal) => {
        impl $Trait for Counted {
            type Output = Counted;
            fn $method(self, other: Counted) -> Counted {
                Counted(self.0 $operator other.0, self.1 + other.1 + $products)
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
        Counted(-self.0, self.1)
    }
}

impl num_traits::Inv for Counted {
    type Output = Counted;
    fn inv(self) -> Counted {
        Counted(1.0, 0) / self
    }
}

impl num_traits::FromPrimitive for Counted {
    fn from_i64(n: i64) -> Option<Counted> {
        Some(Counted(n as f64, 0))
    }
    fn from_u64(n: u64) -> Option<Counted> {
        Some(Counted(n as f64, 0))
    }
}

fn main() -> Result<(), Refusals> {
    let car = Vehicle::new(1200.0, 1900.0).with_impact_center(1.8, 0.3).with_speed(15.0);
    let collision = Collision::new(car, Party::Barrier).with_restitution(0.1);
    let loss = collision.map(|value| Counted(value, 0)).evaluate().loss();
    assert_eq!(loss.0, collision.solve()?.loss());
    println!("an energy loss of {:.0} J, by {} products", loss.0, loss.1);
    Ok(())
}
