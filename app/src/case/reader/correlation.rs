//! The key `correlation`.

use super::CaseReader;
use crate::case::parameter::Parameter;
use crate::case::uncertain::{InputCorrelation, Uncertain};
use crate::document::Field;
use crate::quantity::{Kind, did_you_mean};
use crate::units::Measure;
use crate::wording::percent_meant;

/// What an entry looks like.
const ENTRY: &str = "an array of two names and their coefficient, such as [\"vehicle.1.mass\", \"vehicle.2.mass\", 0.3]";

/// Maximum number of pairs that a message lists.
const MOST_PAIRS: usize = 10;

/// Returns the message and the help for correlations that no inputs have.
fn impossible_together(pairs: &[&InputCorrelation], strongest: &InputCorrelation) -> (String, String) {
    let mut listed: Vec<String> =
        pairs.iter().take(MOST_PAIRS).map(|pair| format!("{} and {} {}", pair.one, pair.other, pair.coefficient)).collect();
    if pairs.len() > MOST_PAIRS {
        listed.push(format!("{} more pairs", pairs.len() - MOST_PAIRS));
    }
    let message = format!("no inputs can have these correlations together, whose matrix is not positive definite: {}", listed.join(", "));
    let help = format!(
        "reduce the correlation of {} and {}, or give that of every other pair of these inputs, which is 0 otherwise",
        strongest.one, strongest.other
    );
    (message, help)
}

impl CaseReader {
    /// Reads the correlations of the uncertain inputs, which have been read before. If not all of them could be, `whole` is `false`, and a name that
    /// is not among them is not reported.
    pub(super) fn correlations(&self, field: Field<'_>, whole: bool) -> Option<Vec<InputCorrelation>> {
        let entries = field.items("an array of correlations", 0..=usize::MAX)?;
        let (mut found, mut places): (Vec<InputCorrelation>, Vec<Field<'_>>) = (Vec::new(), Vec::new());
        let mut sound = true;
        for entry in entries {
            let at = entry.clone();
            let Some(read) = self.correlation(entry, whole) else {
                sound = false;
                continue;
            };
            let is_same =
                |other: &&InputCorrelation| [(other.one, other.other), (other.other, other.one)].contains(&(read.one, read.other));
            if read.one == read.other {
                at.report("it is the correlation of an input with itself, which is 1", None);
                sound = false;
            } else if let Some(other) = found.iter().find(is_same) {
                at.report(format!("{} and {} have a coefficient already", other.one, other.other), Some(format!("see {}", other.key)));
                sound = false;
            } else {
                found.push(read);
                places.push(at);
            }
        }
        if !sound || !whole {
            return None;
        }
        let all = Uncertain { inputs: self.uncertain.borrow().clone(), correlations: found };
        let impossible = all.impossible_pairs();
        if let Some(strongest) = impossible.first() {
            let place = places.iter().find(|place| place.path() == strongest.key);
            let (message, help) = impossible_together(&impossible, strongest);
            place.inspect(|place| place.report(message, Some(help)));
            return None;
        }
        Some(all.correlations)
    }

    fn correlation(&self, field: Field<'_>, whole: bool) -> Option<InputCorrelation> {
        let (key, place_of_pair) = (field.path().to_owned(), field.clone());
        let items = field.items(ENTRY, 3..=3)?;
        let [one, other, coefficient] = <[Field<'_>; 3]>::try_from(items).ok()?;
        let pair = [one, other].map(|name| self.correlated(name, whole));
        let place = coefficient.clone();
        let coefficient = self.quantity(coefficient, Kind::PURE).filter(|coefficient| {
            let is_possible = coefficient.abs() < 1.0;
            if !is_possible {
                place.report_as(
                    "out-of-range",
                    format!("it is {coefficient}; it must be between -1 and 1, both excluded"),
                    percent_meant(*coefficient),
                );
            }
            is_possible
        });
        let [one, other] = pair;
        if let (Some(one), Some(other)) = (one, other)
            && [one, other].contains(&Parameter::RestFriction)
            && ![one, other].iter().any(|parameter| parameter.is_friction_of_skid())
        {
            place_of_pair
                .report(format!("the correlation of {one} and {other}: rest.friction has one with the friction of a skid alone"), None);
            return None;
        }
        if let (Some(one), Some(other), Some(coefficient)) = (one, other, coefficient) {
            let mut names = [one, other].map(|input| input.to_string());
            names.sort();
            let name = format!("correlation of {}", names.join(" and "));
            self.contents.borrow_mut().numbers(&key, [(name, coefficient, Measure::Ratio)]);
        }
        Some(InputCorrelation { one: one?, other: other?, coefficient: coefficient?, key })
    }

    /// Reads the name of an uncertain input.
    fn correlated(&self, field: Field<'_>, whole: bool) -> Option<Parameter> {
        let place = field.clone();
        let name = field.string()?;
        let mut uncertain: Vec<Parameter> = self.uncertain.borrow().iter().map(|input| input.parameter).collect();
        uncertain.extend(self.has_uncertain_rest.get().then_some(Parameter::RestFriction));
        let is_friction_of_rest = name == Parameter::RestFriction.to_string();
        let named = if is_friction_of_rest { Some(Parameter::RestFriction) } else { Parameter::named(name) };
        if named.is_some_and(|parameter| self.is_fitted(parameter)) {
            place.report("the tests that it is fitted to give its correlations", None);
            return None;
        }
        if let Some(parameter) = named.filter(|parameter| !whole || uncertain.contains(parameter)) {
            return Some(parameter);
        }
        let names: Vec<String> = uncertain.iter().map(Parameter::to_string).collect();
        let known = || match names.is_empty() {
            true => "no input of this case is uncertain: give one as \"1500 kg \u{b1} 50 kg\"".to_owned(),
            false => format!("the uncertain inputs are {}", names.join(", ")),
        };
        let help = did_you_mean(name, &names);
        match named {
            Some(parameter) => place.report(format!("the case gives no uncertainty of {parameter}"), Some(known())),
            None => place.report("no input has this name", Some(help.unwrap_or_else(known))),
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::Input;

    #[test]
    fn ten_impossible_pairs_are_listed_and_more_are_counted() {
        let pair = InputCorrelation {
            one: Parameter::Input(Input::Restitution),
            other: Parameter::Friction,
            coefficient: 0.9,
            key: "correlation.1".to_owned(),
        };
        let message = |count: usize| impossible_together(&vec![&pair; count], &pair).0;
        assert!(message(MOST_PAIRS).ends_with("contact.restitution and contact.friction 0.9"), "{}", message(MOST_PAIRS));
        assert!(message(MOST_PAIRS + 2).ends_with("contact.friction 0.9, 2 more pairs"), "{}", message(MOST_PAIRS + 2));
    }
}
