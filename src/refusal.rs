//! What is refused, and why.
//!
//! Nothing is repaired: no sign flipped, no coefficient clamped, no vehicle reordered. All problems are reported, each with its name and number, and
//! the same ones at every scalar that compares with yes or no.

use crate::collision::{Collision, Impact};
use crate::contact::Contact;
use crate::frame::Nt;
use crate::law::ImpulseRatio;
use crate::moment::Moment;
use crate::scalar::{Field, Ordered};
use crate::vehicle::Party;
use alloc::vec::Vec;
use core::fmt;

/// Why a collision is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal<T = f64> {
    /// An input is infinite or not a number.
    NotFinite {
        /// Its name, such as `vehicle.1.mass`.
        input: &'static str,
        /// Its value.
        value: T,
    },
    /// An input must be above zero and is not.
    NotPositive {
        /// Its name.
        input: &'static str,
        /// Its value.
        value: T,
    },
    /// An input must lie between two bounds, both allowed, and does not.
    OutOfRange {
        /// Its name.
        input: &'static str,
        /// Its value.
        value: T,
        /// The least value allowed.
        least: i32,
        /// The greatest value allowed, if there is one.
        greatest: Option<i32>,
    },
    /// A cosine and a sine that are those of no angle.
    NotADirection {
        /// Its name.
        input: &'static str,
        /// cos² + sin², which must be 1.
        length_squared: T,
    },
    /// Both parties are barriers.
    NothingMoves,
    /// The numbers are so large or so small that the result is infinite or not a number.
    OutOfFloatRange,
    /// The vehicles do not approach each other along the normal: they separate, or slide along the crush plane.
    NotClosing {
        /// The normal approach velocity v_n, in m/s.
        approach: T,
        /// The normal component s of center of mass 2 less center of mass 1, in m. They close where v_n s < 0.
        offset: T,
    },
    /// The normal impulse would have to pull.
    Tensile {
        /// The normal impulse that would satisfy the equations in N s, or the change of normal velocity by a unit of it where that is not positive.
        normal: T,
        /// What about it.
        reason: Tension,
    },
    /// The impulse ratio is beyond the critical one, or of the other sign.
    BeyondCritical {
        /// The impulse ratio μ.
        ratio: T,
        /// The ratio of the sticking impulse.
        critical: T,
    },
    /// The vehicles would have more energy after the impact than before.
    EnergyGain {
        /// What they would gain, in J.
        gain: T,
        /// Their kinetic energy before, in J.
        before: T,
    },
}

/// Why an impulse is tensile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tension {
    /// The normal impulse that solves the equations pulls the bodies together.
    Pulls,
    /// At this impulse ratio no push separates them: K_nn + μ K_nt is not positive, and the pair wedges.
    Wedges,
}

/// All the reasons why a collision is refused; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusals<T = f64>(Vec<Refusal<T>>);

impl<T> Refusals<T> {
    /// The reasons, in the order in which they were found.
    pub fn reasons(&self) -> &[Refusal<T>] {
        &self.0
    }
}

impl<T> Refusal<T> {
    /// Whether the mechanics refuses a collision whose numbers are each in order.
    pub fn is_physical(&self) -> bool {
        matches!(self, Refusal::NotClosing { .. } | Refusal::Tensile { .. } | Refusal::BeyondCritical { .. } | Refusal::EnergyGain { .. })
    }

    /// The name of the input that is refused, if it is one alone.
    pub fn input(&self) -> Option<&'static str> {
        match self {
            Refusal::NotFinite { input, .. }
            | Refusal::NotPositive { input, .. }
            | Refusal::OutOfRange { input, .. }
            | Refusal::NotADirection { input, .. } => Some(input),
            _ => None,
        }
    }
}

impl<T: fmt::Display> fmt::Display for Refusal<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::NotFinite { input, value } => write!(f, "{input} is {value}; a finite number is expected"),
            Refusal::NotPositive { input, value } => write!(f, "{input} is {value}; it must be above zero"),
            Refusal::OutOfRange { input, value, least, greatest: Some(greatest) } => {
                write!(f, "{input} is {value}; it must lie between {least} and {greatest}")
            }
            Refusal::OutOfRange { input, value, least, greatest: None } => {
                write!(f, "{input} is {value}; it must be at least {least}")
            }
            Refusal::NotADirection { input, length_squared } => {
                write!(f, "{input} has cos² + sin² = {length_squared}; a direction has 1")
            }
            Refusal::NothingMoves => write!(f, "both parties are fixed barriers; one must be a vehicle"),
            Refusal::OutOfFloatRange => write!(f, "the numbers are too large or too small: the result overflows"),
            Refusal::NotClosing { approach, offset } => write!(
                f,
                "the vehicles do not close: the normal approach velocity is {approach} and the normal component of center of mass 2 \
                 less center of mass 1 is {offset}; a closing pair has them of opposite sign, and neither zero"
            ),
            Refusal::Tensile { normal, reason: Tension::Pulls } => write!(
                f,
                "the normal impulse would have to pull: {normal} on vehicle 1, towards vehicle 2; the contact slides on, so give an impulse ratio \
                 or a friction that lets it"
            ),
            Refusal::Tensile { normal, reason: Tension::Wedges } => write!(
                f,
                "the pair wedges at this impulse ratio: K_nn + μ K_nt is {normal}, and no push along the normal would separate them"
            ),
            Refusal::BeyondCritical { ratio, critical } => {
                write!(f, "the impulse ratio {ratio} is beyond the critical one; it must lie between 0 and {critical}")
            }
            Refusal::EnergyGain { gain, before } => write!(
                f,
                "the vehicles would gain energy: {gain} on top of {before} before the impact; the restitution is too high for this contact"
            ),
        }
    }
}

impl<T: fmt::Display> fmt::Display for Refusals<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, reason) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{reason}")?;
        }
        Ok(())
    }
}

impl<T: fmt::Debug + fmt::Display> core::error::Error for Refusal<T> {}
impl<T: fmt::Debug + fmt::Display> core::error::Error for Refusals<T> {}

/// 2⁻⁴⁸: what is smaller than this share of the terms it was summed from is their rounding.
fn rounding<T: Field>() -> T {
    let step = T::int(1) / T::int(1 << 24);
    step.squared()
}

/// 2⁻⁴⁰: how far a given direction may be from unit length, and a given ratio from a critical one computed elsewhere.
fn slack<T: Field>() -> T {
    let step = T::int(1) / T::int(1 << 20);
    step.squared()
}

fn is_finite<T: Ordered<Mask = bool>>(x: &T) -> bool {
    // Zero for every finite number, and not a number for the others.
    let nothing = x.clone() - x.clone();
    nothing.less(&T::int(1)) && T::int(-1).less(&nothing)
}

fn is_positive<T: Ordered<Mask = bool>>(x: &T) -> bool {
    T::int(0).less(x)
}

fn is_zero<T: Ordered<Mask = bool>>(x: &T) -> bool {
    !is_positive(x) && !x.less(&T::int(0))
}

fn sum_of_magnitudes<T: Ordered>(v: &Nt<T>) -> T {
    v.n.clone().magnitude() + v.t.clone().magnitude()
}

/// The problems found so far.
struct Findings<T>(Vec<Refusal<T>>);

impl<T: Ordered<Mask = bool>> Findings<T> {
    fn finite(&mut self, input: &'static str, value: &T) -> bool {
        let finite = is_finite(value);
        if !finite {
            self.0.push(Refusal::NotFinite { input, value: value.clone() });
        }
        finite
    }

    fn positive(&mut self, input: &'static str, value: &T) {
        if self.finite(input, value) && !is_positive(value) {
            self.0.push(Refusal::NotPositive { input, value: value.clone() });
        }
    }

    fn within(&mut self, input: &'static str, value: &T, least: i32, greatest: Option<i32>) {
        if !self.finite(input, value) {
            return;
        }
        let above = greatest.is_some_and(|greatest| T::int(greatest).less(value));
        if value.less(&T::int(least)) || above {
            self.0.push(Refusal::OutOfRange { input, value: value.clone(), least, greatest });
        }
    }

    fn direction(&mut self, input: &'static str, cos: &T, sin: &T) {
        if self.finite(input, cos) && self.finite(input, sin) {
            let length_squared = cos.clone().squared() + sin.clone().squared();
            let error = (length_squared.clone() - T::int(1)).magnitude();
            if !error.less(&slack()) {
                self.0.push(Refusal::NotADirection { input, length_squared });
            }
        }
    }

    fn party(&mut self, names: &[&'static str; 8], party: &Party<T>) {
        if let Party::Vehicle(vehicle) = party {
            let [mass, inertia, heading, forward, left, vx, vy, yaw_rate] = names;
            self.positive(mass, &vehicle.mass);
            self.positive(inertia, &vehicle.yaw_inertia);
            self.direction(heading, &vehicle.heading.cos, &vehicle.heading.sin);
            self.finite(forward, &vehicle.impact_center.forward);
            self.finite(left, &vehicle.impact_center.left);
            self.finite(vx, &vehicle.motion.velocity.x);
            self.finite(vy, &vehicle.motion.velocity.y);
            self.finite(yaw_rate, &vehicle.motion.yaw_rate);
        }
    }

    fn done(self) -> Result<(), Refusals<T>> {
        if self.0.is_empty() { Ok(()) } else { Err(Refusals(self.0)) }
    }
}

const ONE: [&str; 8] = [
    "vehicle.1.mass",
    "vehicle.1.yaw_inertia",
    "vehicle.1.heading",
    "vehicle.1.impact_center.forward",
    "vehicle.1.impact_center.left",
    "vehicle.1.velocity.x",
    "vehicle.1.velocity.y",
    "vehicle.1.yaw_rate",
];

const TWO: [&str; 8] = [
    "vehicle.2.mass",
    "vehicle.2.yaw_inertia",
    "vehicle.2.heading",
    "vehicle.2.impact_center.forward",
    "vehicle.2.impact_center.left",
    "vehicle.2.velocity.x",
    "vehicle.2.velocity.y",
    "vehicle.2.yaw_rate",
];

impl<T: Ordered<Mask = bool>> Collision<T> {
    /// The impact, or every reason why there is none.
    ///
    /// # Errors
    ///
    /// [`Refusals`]: an input that is not finite or outside its range, or a collision that the mechanics refuses.
    pub fn solve(&self) -> Result<Impact<T>, Refusals<T>> {
        self.check_inputs()?;
        let contact = self.contact();
        if !is_finite(&contact.compliance.determinant) || !is_positive(&contact.compliance.determinant) {
            return Err(Refusals([Refusal::OutOfFloatRange].into()));
        }
        self.check_closing(&contact)?;
        self.check_ratio(&contact)?;
        let (impulse, moment) = self.impulse(&contact);
        let impact = self.impact_of(&contact, impulse, moment);
        self.check_impact(&contact, &impact)?;
        Ok(impact)
    }

    fn check_inputs(&self) -> Result<(), Refusals<T>> {
        let mut findings = Findings(Vec::new());
        findings.party(&ONE, &self.one);
        findings.party(&TWO, &self.two);
        if self.one.vehicle().is_none() && self.two.vehicle().is_none() {
            findings.0.push(Refusal::NothingMoves);
        }
        findings.direction("contact.crush_plane", &self.crush_plane.cos, &self.crush_plane.sin);
        findings.within("contact.restitution", &self.restitution, 0, Some(1));
        match &self.impulse_ratio {
            ImpulseRatio::Critical => (),
            ImpulseRatio::Given(ratio) => drop(findings.finite("contact.impulse_ratio", ratio)),
            ImpulseRatio::OfCritical(fraction) => drop(findings.finite("contact.impulse_ratio.of_critical", fraction)),
            ImpulseRatio::LimitedByFriction(friction) => findings.within("contact.friction", friction, 0, None),
        }
        match &self.moment {
            Moment::None => (),
            Moment::Given(moment) => drop(findings.finite("contact.moment", moment)),
            Moment::OfCritical(fraction) => findings.within("contact.moment.of_critical", fraction, 0, Some(1)),
        }
        findings.done()
    }

    /// They close where v_n s < 0, both of them more than the rounding of their terms.
    fn check_closing(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        let (one, two) = (&contact.one, &contact.two);
        let speeds = sum_of_magnitudes(&one.velocity)
            + sum_of_magnitudes(&two.velocity)
            + sum_of_magnitudes(&one.arm) * one.yaw_rate.clone().magnitude()
            + sum_of_magnitudes(&two.arm) * two.yaw_rate.clone().magnitude();
        let arms = sum_of_magnitudes(&one.arm) + sum_of_magnitudes(&two.arm);
        let (approach, offset) = (contact.approach.n.clone(), contact.offset().n);
        let moves = (speeds * rounding()).less(&approach.clone().magnitude());
        let apart = (arms * rounding()).less(&offset.clone().magnitude());
        if moves && apart && is_positive(&approach) != is_positive(&offset) {
            Ok(())
        } else {
            Err(Refusals([Refusal::NotClosing { approach, offset }].into()))
        }
    }

    /// That the ratio can be evaluated: nothing divides by zero, and the sticking impulse that it is a fraction of pushes.
    fn check_ratio(&self, contact: &Contact<T>) -> Result<(), Refusals<T>> {
        match &self.impulse_ratio {
            ImpulseRatio::Given(ratio) => {
                let normal = contact.compliance.along_ratio(ratio.clone());
                if !is_positive(&normal) {
                    return Err(Refusals([Refusal::Tensile { normal, reason: Tension::Wedges }].into()));
                }
            }
            ImpulseRatio::OfCritical(fraction) => {
                let sticking = self.sticking_impulse(contact);
                // None of it at all is none of it, even where the whole would pull.
                let none = is_zero(fraction) && !is_zero(&sticking.n);
                if !none {
                    self.check_push(contact, &sticking)?;
                }
                if fraction.less(&T::int(0)) || T::int(1).less(fraction) {
                    let critical = sticking.t / sticking.n;
                    let ratio = fraction.clone() * critical.clone();
                    return Err(Refusals([Refusal::BeyondCritical { ratio, critical }].into()));
                }
            }
            ImpulseRatio::Critical | ImpulseRatio::LimitedByFriction(_) => (),
        }
        Ok(())
    }

    /// The impulse that ends the tangential process, whichever ratio is in force.
    fn sticking_impulse(&self, contact: &Contact<T>) -> Nt<T> {
        Collision { impulse_ratio: ImpulseRatio::Critical, ..self.clone() }.impulse(contact).0
    }

    /// The impulse must push body one away from body two, as the approach does.
    fn check_push(&self, contact: &Contact<T>, impulse: &Nt<T>) -> Result<(), Refusals<T>> {
        if is_positive(&(impulse.n.clone() * contact.approach.n.clone())) {
            Ok(())
        } else {
            Err(Refusals([Refusal::Tensile { normal: impulse.n.clone(), reason: Tension::Pulls }].into()))
        }
    }

    fn check_impact(&self, contact: &Contact<T>, impact: &Impact<T>) -> Result<(), Refusals<T>> {
        let results = [
            &impact.impulse.n,
            &impact.impulse.t,
            &impact.moment,
            &impact.work.n,
            &impact.work.t,
            &impact.work.m,
            &impact.one.after.yaw_rate,
            &impact.two.after.yaw_rate,
            &impact.kinetic_energy.before,
            &impact.kinetic_energy.after,
        ];
        if !results.into_iter().all(is_finite) {
            return Err(Refusals([Refusal::OutOfFloatRange].into()));
        }
        self.check_push(contact, &impact.impulse)?;
        let mut findings = Findings(Vec::new());
        if let ImpulseRatio::Given(ratio) = &self.impulse_ratio {
            let sticking = self.sticking_impulse(contact);
            // Of tangential impulses with the same normal change, those between none and the sticking one: the ratio itself has no bound
            // where the sticking impulse would pull.
            let limit = sticking.t.clone().magnitude() * (T::int(1) + slack());
            let against = (impact.impulse.t.clone() * sticking.t.clone()).less(&T::int(0));
            if against || limit.less(&impact.impulse.t.clone().magnitude()) {
                findings.0.push(Refusal::BeyondCritical { ratio: ratio.clone(), critical: sticking.t / sticking.n });
            }
        }
        let loss = impact.loss();
        let exchanged = impact.work.n.clone().magnitude()
            + impact.work.t.clone().magnitude()
            + impact.work.m.clone().magnitude()
            + (impact.impulse.n.clone() * impact.approach.n.clone()).magnitude();
        if loss.less(&-(exchanged * slack())) {
            findings.0.push(Refusal::EnergyGain { gain: -loss, before: impact.kinetic_energy.before.clone() });
        }
        findings.done()
    }
}
