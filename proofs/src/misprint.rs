//! What is wrong in print, each by one collision in exact fractions.
//!
//! Both forms are computed: the printed one breaks a law of mechanics, the form used keeps it. A value that the two have in common shows nothing, and the run
//! fails.

mod equations;
mod motions;
mod statements;

use num_rational::BigRational;

/// An equation or a statement that is wrong as printed, and a collision that shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misprint {
    /// Where it stands.
    pub place: &'static str,
    /// What it says.
    pub stated: &'static str,
    /// What holds.
    pub holds: &'static str,
    /// The law that this breaks.
    pub breaks: &'static str,
    /// All inputs of the collision.
    pub inputs: Vec<Input>,
    /// What comes of them.
    pub findings: Vec<Finding>,
}

/// A given number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its letter.
    pub name: &'static str,
    /// Its value.
    pub value: BigRational,
}

/// A quantity, as it is stated and as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is computed.
    pub quantity: &'static str,
    /// What comes of the form as stated, or what is said of it.
    pub stated: String,
    /// What the motions before and after the impact say.
    pub holds: String,
    /// Whether the two differ, and the right form has what holds.
    pub shows: bool,
}

impl Misprint {
    /// Whether every quantity shows it.
    pub fn is_shown(&self) -> bool {
        !self.findings.is_empty() && self.findings.iter().all(|finding| finding.shows)
    }
}

impl Finding {
    /// A quantity by the form as stated, by the right one, and by the motions, which must agree with the right one alone.
    fn values(quantity: &'static str, stated: BigRational, right: &BigRational, demanded: &BigRational) -> Self {
        Finding { quantity, shows: stated != *demanded && right == demanded, stated: stated.to_string(), holds: demanded.to_string() }
    }

    /// A quantity of which something is said, and whether what is found shows what it has to.
    fn says(quantity: &'static str, stated: &str, found: &BigRational, shows: bool) -> Self {
        Finding { quantity, stated: stated.to_owned(), holds: found.to_string(), shows }
    }
}

/// All of them, in the order of the paper.
pub fn all() -> Vec<Misprint> {
    [equations::all(), statements::all()].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_misprint_is_shown_by_its_collision() {
        for misprint in all() {
            assert!(misprint.is_shown(), "{misprint:#?}");
            assert!(!misprint.inputs.is_empty());
        }
    }

    #[test]
    fn a_right_equation_is_no_misprint() {
        let one = BigRational::from_integer(1.into());
        let two = BigRational::from_integer(2.into());
        assert!(!Finding::values("right", one.clone(), &one, &one).shows);
        assert!(!Finding::values("both wrong", one.clone(), &one, &two).shows);
        assert!(Finding::values("wrong", one, &two, &two).shows);
    }
}
