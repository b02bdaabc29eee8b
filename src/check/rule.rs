//! Rules for checking a record.

use core::fmt;

/// A rule. Other programs rely on its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Rule {
    /// Every number is finite.
    Finite,
    /// The numbers have the size of those of vehicles.
    PlausibleUnits,
    /// The linear momentum gained by one body is lost by the other.
    LinearMomentum,
    /// The angular momentum gained by one body is lost by the other.
    AngularMomentum,
    /// The impulse acts at the contact point.
    LineOfAction,
    /// The impact does not create energy.
    EnergyGain,
    /// The normal impulse is compressive, on bodies that approach each other.
    Compressive,
    /// The bodies no longer approach each other after the impact.
    Interpenetration,
    /// The bodies separate as the restitution requires, which is between 0 and 1.
    Restitution,
    /// The impulse has the stated ratio.
    ImpulseRatio,
    /// The tangential impulse does not exceed the one that ends sliding.
    BeyondCritical,
    /// The works of the impulse equal the change of energy.
    WorkIdentity,
    /// Reported results agree with the motions and with each other.
    Reported,
    /// The records of a group agree.
    Group,
}

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Severity {
    /// Possible, but rarely intended.
    Warn,
    /// The rule could not be evaluated: the numbers are too coarse.
    Undecidable,
    /// The rule is broken.
    Fail,
}

impl Severity {
    /// Returns its name in a report.
    pub const fn name(self) -> &'static str {
        match self {
            Severity::Warn => "warn",
            Severity::Undecidable => "undecidable",
            Severity::Fail => "fail",
        }
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Rule {
    /// Number of rules.
    pub const COUNT: usize = 14;

    /// Every rule, in the order in which they are checked.
    pub const ALL: [Rule; Rule::COUNT] = [
        Rule::Finite,
        Rule::PlausibleUnits,
        Rule::LinearMomentum,
        Rule::AngularMomentum,
        Rule::LineOfAction,
        Rule::EnergyGain,
        Rule::Compressive,
        Rule::Interpenetration,
        Rule::Restitution,
        Rule::ImpulseRatio,
        Rule::BeyondCritical,
        Rule::WorkIdentity,
        Rule::Reported,
        Rule::Group,
    ];

    /// Returns its name, such as `linear-momentum`.
    pub const fn name(self) -> &'static str {
        match self {
            Rule::Finite => "finite",
            Rule::PlausibleUnits => "plausible-units",
            Rule::LinearMomentum => "linear-momentum",
            Rule::AngularMomentum => "angular-momentum",
            Rule::LineOfAction => "line-of-action",
            Rule::EnergyGain => "energy-gain",
            Rule::Compressive => "compressive",
            Rule::Interpenetration => "interpenetration",
            Rule::Restitution => "restitution",
            Rule::ImpulseRatio => "impulse-ratio",
            Rule::BeyondCritical => "beyond-critical",
            Rule::WorkIdentity => "work-identity",
            Rule::Reported => "reported",
            Rule::Group => "group",
        }
    }

    /// Returns the rule with a name.
    pub fn named(name: &str) -> Option<Rule> {
        Rule::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// Returns the severity of a violation.
    pub const fn severity(self) -> Severity {
        match self {
            Rule::PlausibleUnits => Severity::Warn,
            _ => Severity::Fail,
        }
    }

    /// Returns the law in a sentence or two, and the quantities it needs.
    pub const fn help(self) -> &'static str {
        match self {
            Rule::Finite => {
                "Every number is finite, masses and yaw inertias are above zero, resolutions are not below it, and one body can move. \
                 Nothing else is checked of a record that breaks this rule. A tolerance out of range breaks it too."
            }
            Rule::PlausibleUnits => {
                "The numbers are of the size that vehicles have: radius of gyration 0.9 to 2.5 m, mass 100 kg to 80 t, speed below 150 m/s, \
                 yaw rate below 30 rad/s, contact within 15 m and 1 s, angles within one turn. A warning. Of a stepping engine, whose bodies may have any \
                 size, only angles are looked at."
            }
            Rule::LinearMomentum => {
                "What one body gains in linear momentum the other loses. A fixed body keeps its velocity. Needs the masses and the velocities \
                 before and after."
            }
            Rule::AngularMomentum => {
                "What one body gains in angular momentum about any point the other loses. Needs centers of mass, yaw inertias and yaw rates too; of a \
                 contact that lasts, the centers of mass after it."
            }
            Rule::LineOfAction => {
                "The impulse on each body acts at the contact point: its angular momentum about that point changes by the moment impulse alone, \
                 which is zero unless it is given. Needs the contact point too."
            }
            Rule::EnergyGain => {
                "The kinetic energy after the impact is not above that before, for an observer on the ground and for one who moves along with the \
                 pair. A gain of translation alone, where yaw is not known, is a warning."
            }
            Rule::Compressive => {
                "The bodies approach each other along the normal before the impact, and the normal impulse pushes them apart. Which way that is \
                 follows from the centers of mass; the normal may point either way. Needs the normal."
            }
            Rule::Interpenetration => "After the impact the bodies do not approach each other along the normal any more.",
            Rule::Restitution => {
                "The normal separation velocity is restitution times the approach, turned around, and the restitution is between 0 and 1. It is a \
                 warning that at the critical impulse ratio it is above the bound up to which no approach velocity gains energy."
            }
            Rule::ImpulseRatio => {
                "The tangential impulse is the ratio times the normal one; at the critical ratio sliding has ended. It is a warning that the \
                 tangential impulse first speeds the sliding up, or that the pair nearly wedges at this ratio."
            }
            Rule::BeyondCritical => {
                "The tangential impulse ends the sliding at most: it does not turn it around, and does not speed it up. Where the sticking impulse \
                 would pull, the critical ratio bounds nothing, and this still holds."
            }
            Rule::WorkIdentity => {
                "The works of the normal and of the tangential impulse and of the moment are together the change of kinetic energy. A positive tangential work is a \
                 warning: it is possible."
            }
            Rule::Reported => {
                "Results that are reported (loss, works, kinetic energies, delta-V, direction of force, impulse, ratios, closing speed, EES) agree \
                 with what the motions imply, given or those that an impulse or the model leads to, and with each other."
            }
            Rule::Group => {
                "The records of a group have the same energy loss and the same impulse, as in a sweep of the crush plane at e = 0 and the critical \
                 ratio. Those that disagree with more than half of the group are found."
            }
        }
    }

    /// Returns the law, with its equations in the source paper and its place in this crate.
    pub const fn law(self) -> &'static str {
        match self {
            Rule::Finite | Rule::PlausibleUnits => "no law of mechanics",
            Rule::LinearMomentum => "m1 (V1 - v1) + m2 (V2 - v2) = 0 (Eqs A1-A4, A22, A23; Body::delta_v)",
            Rule::AngularMomentum => "sum of I (W - w) + c x m (V - v) = 0, c the center of mass (Eqs A5, A6)",
            Rule::LineOfAction => {
                "I (W - w) = r x m (V - v) + M, r from the center of mass to the contact point, M on body 1 and -M on body 2 \
                 (Eqs A5, A6; Body::delta_yaw_rate)"
            }
            Rule::EnergyGain => "T_L = T - T' >= 0, T = sum of 1/2 m v^2 + 1/2 I w^2 (Eq 1; Vehicle::kinetic_energy, Admissible)",
            Rule::Compressive => {
                "v_n s < 0 and P_n s < 0, s = n . (center of mass 2 - center of mass 1) (Contact::offset, Collision::solve)"
            }
            Rule::Interpenetration => "V_n s >= 0 (Contact::separation)",
            Rule::Restitution => "V_n = -e v_n, 0 <= e <= 1 (Eq A7); e^2 <= 1 - K_nt^2/(K_nn K_tt) for no gain (Admissible)",
            Rule::ImpulseRatio => "P_t = mu P_n (Eq A8); V_t = 0 at the critical ratio, -e v_t with Kudlich and Slibar's law (Eq A27; Law)",
            Rule::BeyondCritical => "P_t V_t >= 0, so that mu lies between 0 and mu0 (Eq A27; Refusal::BeyondCritical)",
            Rule::WorkIdentity => "W_n + W_t + W_m = T' - T, W = -1/2 P (v + V), W_m = -1/2 M (w_r + W_r) (Eqs 5-8; Work)",
            Rule::Reported => "T_L = -(W_n + W_t + W_m), dV = |P|/m, mu = P_t/P_n, sum of 1/2 m EES^2 = -W_n (Eqs 1-9, A22-A27; Impact)",
            Rule::Group => "T_L and |P| at e = 0, mu = mu0 do not depend on the crush plane (Contact::greatest_loss)",
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A set of rules.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Rules(u16);

impl Rules {
    pub(super) fn insert(&mut self, rule: Rule) {
        self.0 |= 1 << rule as u16;
    }

    pub(super) fn contains(self, rule: Rule) -> bool {
        self.0 & (1 << rule as u16) != 0
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Rules {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(Rule::ALL.into_iter().filter(|rule| self.contains(*rule)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_has_its_name_and_says_what_it_means() {
        for (i, rule) in Rule::ALL.into_iter().enumerate() {
            assert_eq!(rule as usize, i);
            assert_eq!(Rule::named(rule.name()), Some(rule));
            assert!(rule.help().ends_with('.') && rule.help().len() > 40, "{rule}");
            assert!(!rule.law().is_empty(), "{rule}");
        }
        assert_eq!(Rule::named("momentum"), None);
    }

    #[test]
    fn a_set_holds_what_was_put_in() {
        let mut rules = Rules::default();
        rules.insert(Rule::Group);
        assert!(Rule::ALL.into_iter().all(|rule| rules.contains(rule) == (rule == Rule::Group)));
    }
}
