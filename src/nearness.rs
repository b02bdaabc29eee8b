//! Comparisons within a tolerance, of every part of a number: derivatives as well as values.
//!
//! The comparisons of num-dual look at real parts alone, as its `==` does, so that a wrong derivative passes a test. Those of this crate compare each part,
//! and the tolerance is a plain number.

use approx::{AbsDiffEq, RelativeEq};

use crate::crush::{CrushStiffness, ProfileMoments};
use crate::energy::{KineticEnergy, Work};
use crate::frame::{CrushPlane, ForwardLeft, Heading, Nt, Xy};
use crate::impact::{Impact, Response};
use crate::output::{Output, Outputs};
use crate::sensitivity::{Curved, Gradient, Hessian, Sensitive};
use crate::vehicle::{Motion, Vehicle};

/// A number, or a structure of numbers, that is made of floats.
pub trait Parts {
    /// Calls a function with each part, in a fixed order.
    fn for_each_part(&self, part: &mut dyn FnMut(f64));
}

impl Parts for f64 {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        part(*self);
    }
}

impl Parts for f32 {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        part(f64::from(*self));
    }
}

/// Returns `true` if both have as many parts and each pair of them is close.
fn all_close(one: &impl Parts, other: &impl Parts, is_close: impl Fn(f64, f64) -> bool) -> bool {
    let mut parts = alloc::vec::Vec::new();
    one.for_each_part(&mut |part| parts.push(part));
    let (mut place, mut close) = (0, true);
    other.for_each_part(&mut |part| {
        close &= parts.get(place).is_some_and(|one| is_close(*one, part));
        place += 1;
    });
    close && place == parts.len()
}

macro_rules! parts {
    ($($Type:ident { $($($field:ident).+),+ })+) => { $(
        impl<T: Parts> Parts for $Type<T> {
            fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
                $(self.$($field).+.for_each_part(part);)+
            }
        }

        near!($Type<T>, T: Parts + PartialEq);
    )+ };
}

macro_rules! near {
    ($Type:ty $(, $T:ident: $Bound:ident + $Other:ident)?) => {
        impl$(<$T: $Bound + $Other>)? AbsDiffEq for $Type {
            type Epsilon = f64;

            fn default_epsilon() -> f64 {
                f64::EPSILON
            }

            fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
                all_close(self, other, |one, other| one.abs_diff_eq(&other, epsilon))
            }
        }

        impl$(<$T: $Bound + $Other>)? RelativeEq for $Type {
            fn default_max_relative() -> f64 {
                f64::EPSILON
            }

            fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
                all_close(self, other, |one, other| one.relative_eq(&other, epsilon, max_relative))
            }
        }
    };
}

parts! {
    Xy { x, y }
    Nt { n, t }
    ForwardLeft { forward, left }
    Heading { cos, sin }
    CrushPlane { cos, sin }
    Motion { velocity, yaw_rate }
    Vehicle { mass, yaw_inertia, heading, impact_center, motion }
    Work { n, t, m }
    KineticEnergy { before, after }
    Response { after, delta_v, delta_v_in_vehicle }
    Impact { impulse, impulse_on_ground, moment, critical_impulse, approach, separation, one, two, work, kinetic_energy }
    CrushStiffness { onset, slope }
    ProfileMoments { first, second, third }
}

impl<T: Parts> Parts for Outputs<T> {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        for output in Output::ALL {
            self[output].for_each_part(part);
        }
    }
}

near!(Outputs<T>, T: Parts + PartialEq);

impl<T: Parts> Parts for Gradient<T> {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        self.0.iter().for_each(|by| by.for_each_part(part));
    }
}

impl<T: Parts> Parts for Hessian<T> {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        self.0.iter().flatten().for_each(|by| by.for_each_part(part));
    }
}

impl<T: Parts> Parts for Sensitive<T> {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        self.value.for_each_part(part);
        self.by.for_each_part(part);
    }
}

impl<T: Parts> Parts for Curved<T> {
    fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
        self.value.for_each_part(part);
        self.by.for_each_part(part);
        self.twice.for_each_part(part);
    }
}

near!(Gradient<T>, T: Parts + PartialEq);
near!(Hessian<T>, T: Parts + PartialEq);
near!(Sensitive<T>, T: Parts + PartialEq);
near!(Curved<T>, T: Parts + PartialEq);

#[cfg(feature = "dual")]
mod dual {
    use super::Parts;
    use num_dual::{Dual, Dual2, HyperDual};

    impl<T: Parts> Parts for Dual<T> {
        fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
            self.re.for_each_part(part);
            self.eps.for_each_part(part);
        }
    }

    impl<T: Parts> Parts for Dual2<T> {
        fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
            self.re.for_each_part(part);
            self.v1.for_each_part(part);
            self.v2.for_each_part(part);
        }
    }

    impl<T: Parts> Parts for HyperDual<T> {
        fn for_each_part(&self, part: &mut dyn FnMut(f64)) {
            for of in [&self.re, &self.eps1, &self.eps2, &self.eps1eps2] {
                of.for_each_part(part);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_abs_diff_ne, assert_relative_eq};

    #[test]
    fn each_part_counts() {
        assert_abs_diff_eq!(Xy::new(1.0, 2.0), Xy::new(1.0, 2.0 + 1e-9), epsilon = 1e-8);
        assert_abs_diff_ne!(Xy::new(1.0, 2.0), Xy::new(1.0, 2.1), epsilon = 1e-8);
        assert_relative_eq!(Nt::new(1e9, 0.0), Nt::new(1e9 + 1.0, 0.0), max_relative = 1e-8);
        assert_abs_diff_ne!(Xy::new(1.0, f64::NAN), Xy::new(1.0, f64::NAN), epsilon = 1.0);
    }

    #[cfg(feature = "dual")]
    #[test]
    fn a_derivative_is_a_part() {
        use num_dual::Dual64;
        let velocity = |eps| Xy::new(Dual64::new(1.0, 0.0), Dual64::new(2.0, eps));
        assert_abs_diff_eq!(velocity(3.0), velocity(3.0 + 1e-12), epsilon = 1e-9);
        assert_abs_diff_ne!(velocity(3.0), velocity(3.1), epsilon = 1e-9);
    }
}
