//! The form of a row: everything of a collision but its numbers.

use crate::collision::Collision;
use crate::law::{ImpulseRatio, Law};
use crate::moment::Moment;
use crate::scalar::Field;
use crate::vehicle::{Party, Vehicle};

/// How the impulse ratio of a row is given. Its number, if it has one, is in the column [`Input::ImpulseRatio`](crate::Input::ImpulseRatio).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RatioForm {
    /// As [`ImpulseRatio::Critical`].
    #[default]
    Critical,
    /// As [`ImpulseRatio::Given`].
    Given,
    /// As [`ImpulseRatio::OfCritical`].
    OfCritical,
    /// As [`ImpulseRatio::LimitedByFriction`].
    LimitedByFriction,
}

/// How the moment impulse of a row is given. Its number, if it has one, is in the column [`Input::Moment`](crate::Input::Moment).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MomentForm {
    /// As [`Moment::None`].
    #[default]
    None,
    /// As [`Moment::Given`].
    Given,
    /// As [`Moment::OfCritical`].
    OfCritical,
}

/// The form of a row: which parties are vehicles, and how its contact is given. Rows of different forms may stand in one batch; those that stand together are
/// computed fastest.
///
/// ```
/// use planar_impact::batch::{Form, RatioForm};
/// use planar_impact::{Collision, Law, Party, Vehicle};
/// let form = Form::of(&Collision::new(Vehicle::<f64>::default(), Party::Barrier).with_law(Law::KudlichSlibar));
/// assert_eq!(form, Form { is_vehicle: [true, false], ratio: RatioForm::Critical, law: Law::KudlichSlibar, ..Form::default() });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Form {
    /// `true` for each party that is a vehicle, `false` if it is a barrier.
    pub is_vehicle: [bool; 2],
    /// How the impulse ratio is given.
    pub ratio: RatioForm,
    /// The impulse that ends the tangential process.
    pub law: Law,
    /// How the moment impulse is given.
    pub moment: MomentForm,
}

impl Default for Form {
    /// Two vehicles, the critical ratio of the paper's law, and no moment.
    fn default() -> Self {
        Form { is_vehicle: [true; 2], ratio: RatioForm::Critical, law: Law::Brach, moment: MomentForm::None }
    }
}

impl Form {
    /// Returns the form of a collision.
    pub fn of<T>(collision: &Collision<T>) -> Self {
        Form {
            is_vehicle: collision.parties().map(|party| party.vehicle().is_some()),
            ratio: match collision.impulse_ratio {
                ImpulseRatio::Critical => RatioForm::Critical,
                ImpulseRatio::Given(_) => RatioForm::Given,
                ImpulseRatio::OfCritical(_) => RatioForm::OfCritical,
                ImpulseRatio::LimitedByFriction(_) => RatioForm::LimitedByFriction,
            },
            law: collision.law,
            moment: match collision.moment {
                Moment::None => MomentForm::None,
                Moment::Given(_) => MomentForm::Given,
                Moment::OfCritical(_) => MomentForm::OfCritical,
            },
        }
    }

    /// Returns `true` if tiles compute rows of this form. A moment impulse is rare, and two barriers do not collide.
    pub(super) fn is_in_tiles(self) -> bool {
        self.moment == MomentForm::None && self.is_vehicle != [false; 2]
    }

    /// Returns a collision of this form, each number of which is still to be given.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn collision<T: Field>(self) -> Collision<T> {
        let nothing = || T::int(0);
        let party = |is_vehicle: bool| match is_vehicle {
            true => Party::Vehicle(Vehicle::new(nothing(), nothing())),
            false => Party::Barrier,
        };
        let [one, two] = self.is_vehicle;
        Collision {
            impulse_ratio: match self.ratio {
                RatioForm::Critical => ImpulseRatio::Critical,
                RatioForm::Given => ImpulseRatio::Given(nothing()),
                RatioForm::OfCritical => ImpulseRatio::OfCritical(nothing()),
                RatioForm::LimitedByFriction => ImpulseRatio::LimitedByFriction(nothing()),
            },
            law: self.law,
            moment: match self.moment {
                MomentForm::None => Moment::None,
                MomentForm::Given => Moment::Given(nothing()),
                MomentForm::OfCritical => Moment::OfCritical(nothing()),
            },
            ..Collision::new(party(one), party(two))
        }
    }
}
