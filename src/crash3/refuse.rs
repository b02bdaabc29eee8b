//! What the damage algorithm refuses.

use super::damage::{DamagedPair, PairEstimate};
use crate::refusal::{Refusal, Refusals};
use crate::scalar::Real;
use crate::solve::Findings;

impl<T: Real<Mask = bool>> DamagedPair<T> {
    /// What the damage says, refused where it cannot say anything.
    ///
    /// # Errors
    ///
    /// A mass or a yaw inertia that is not above zero, a crush energy below zero, a force from nowhere, a number that is not finite, or two barriers:
    /// each of them.
    pub fn solve(&self) -> Result<PairEstimate<T>, Refusals<T>> {
        let mut findings = Findings::none();
        for (damaged, names) in [(&self.one, &ONE), (&self.two, &TWO)] {
            if let Some(damaged) = damaged {
                findings.positive(names.mass, &damaged.mass);
                findings.positive(names.yaw_inertia, &damaged.yaw_inertia);
                findings.finite(names.forward, &damaged.impact_center.forward);
                findings.finite(names.left, &damaged.impact_center.left);
                findings.within(names.crush_energy, &damaged.crush_energy, 0, None);
                let length_squared = damaged.origin_squared();
                if findings.finite(names.pdof, &length_squared) && !T::int(0).less(&length_squared) {
                    findings.add(Refusal::NotADirection { input: names.pdof, length_squared });
                }
            }
        }
        if self.one.is_none() && self.two.is_none() {
            findings.add(Refusal::NothingMoves);
        }
        findings.done()?;
        Ok(self.evaluate())
    }
}

struct Names {
    mass: &'static str,
    yaw_inertia: &'static str,
    forward: &'static str,
    left: &'static str,
    crush_energy: &'static str,
    pdof: &'static str,
}

const ONE: Names = Names {
    mass: "vehicle.1.mass",
    yaw_inertia: "vehicle.1.yaw_inertia",
    forward: "vehicle.1.impact_center.forward",
    left: "vehicle.1.impact_center.left",
    crush_energy: "vehicle.1.crush_energy",
    pdof: "vehicle.1.crush.pdof",
};

const TWO: Names = Names {
    mass: "vehicle.2.mass",
    yaw_inertia: "vehicle.2.yaw_inertia",
    forward: "vehicle.2.impact_center.forward",
    left: "vehicle.2.impact_center.left",
    crush_energy: "vehicle.2.crush_energy",
    pdof: "vehicle.2.crush.pdof",
};

#[cfg(test)]
mod tests {
    use super::super::Damaged;
    use super::super::damage::tests::damaged;
    use super::*;
    use crate::impact::ForceOrigin;
    use alloc::vec::Vec;

    #[test]
    fn everything_wrong_is_refused_at_once() {
        let nowhere = ForceOrigin { ahead: 0.0, right: 0.0 };
        let wrong = Damaged { mass: -1.0, yaw_inertia: f64::NAN, crush_energy: -8.0, force_origin: nowhere, ..damaged() };
        let refusals = DamagedPair { one: None, two: Some(wrong) }.solve().expect_err("four numbers are wrong");
        let inputs: Vec<_> = refusals
            .reasons()
            .iter()
            .map(|reason| match reason {
                Refusal::NotPositive { input, .. }
                | Refusal::NotFinite { input, .. }
                | Refusal::OutOfRange { input, .. }
                | Refusal::NotADirection { input, .. } => *input,
                _ => "",
            })
            .collect();
        assert_eq!(inputs, ["vehicle.2.mass", "vehicle.2.yaw_inertia", "vehicle.2.crush_energy", "vehicle.2.crush.pdof"]);
        let barriers = DamagedPair::<f64> { one: None, two: None }.solve().expect_err("nothing moves");
        assert_eq!(barriers.reasons(), [Refusal::NothingMoves]);
        let fine = DamagedPair { one: Some(damaged()), two: None };
        assert_eq!(fine.solve(), Ok(fine.evaluate()));
    }
}
