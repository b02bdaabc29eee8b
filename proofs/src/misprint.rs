//! Errors in print, each demonstrated by one collision in exact fractions.
//!
//! Both forms are computed: the printed one violates a law of mechanics, the form used satisfies it. A quantity equal
//! in both forms demonstrates nothing, and makes the run fail.

mod equations;
mod motions;
mod statements;

use num_rational::BigRational;

/// An equation or a statement that is wrong as printed, and a collision that demonstrates it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misprint {
    /// Its place in the paper.
    pub place: &'static str,
    /// The printed form.
    pub stated: &'static str,
    /// The correct form.
    pub holds: &'static str,
    /// The law that the printed form violates.
    pub breaks: &'static str,
    /// All inputs of the collision.
    pub inputs: Vec<Input>,
    /// Results computed from the inputs.
    pub findings: Vec<Finding>,
}

/// A given number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its symbol.
    pub name: &'static str,
    /// Its value.
    pub value: BigRational,
}

/// A quantity, as stated and as correct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The quantity.
    pub quantity: &'static str,
    /// The result of the stated form, or a statement about the quantity.
    pub stated: String,
    /// The result from the motions before and after the impact.
    pub holds: String,
    /// `true` if the two differ, and the correct form gives the second.
    pub shows: bool,
}

impl Misprint {
    /// Returns `true` if every quantity demonstrates it.
    pub fn is_shown(&self) -> bool {
        !self.findings.is_empty() && self.findings.iter().all(|finding| finding.shows)
    }
}

impl Finding {
    /// Compares the stated form and the correct form of a quantity with the motions, which must agree only with the correct form.
    fn values(quantity: &'static str, stated: BigRational, right: &BigRational, demanded: &BigRational) -> Self {
        Finding { quantity, shows: stated != *demanded && right == demanded, stated: stated.to_string(), holds: demanded.to_string() }
    }

    /// Compares a statement about a quantity with the computed value; `shows` is `true` if that demonstrates the misprint.
    fn says(quantity: &'static str, stated: &str, found: &BigRational, shows: bool) -> Self {
        Finding { quantity, stated: stated.to_owned(), holds: found.to_string(), shows }
    }
}

/// Returns all misprints, in the order of the paper.
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
