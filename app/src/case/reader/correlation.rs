//! The key `correlation`.

use super::CaseReader;
use crate::case::parameter::Parameter;
use crate::case::uncertain::{InputCorrelation, Uncertain};
use crate::document::Field;
use crate::quantity::{Kind, nearest};
use crate::wording::percent_meant;

/// What an entry looks like.
const ENTRY: &str = "an array of two names and their coefficient, such as [\"vehicle.1.mass\", \"vehicle.2.mass\", 0.3]";

impl CaseReader {
    /// Reads the correlations of the uncertain inputs, which have been read before. If not all of them could be, `whole` is `false`, and a name that
    /// is not among them is not reported.
    pub(super) fn correlations(&self, field: Field<'_>, whole: bool) -> Option<Vec<InputCorrelation>> {
        let place = field.clone();
        let entries = field.items("an array of correlations", 0..=usize::MAX)?;
        let mut found: Vec<InputCorrelation> = Vec::new();
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
            }
        }
        if !sound || !whole {
            return None;
        }
        let all = Uncertain { inputs: self.uncertain.borrow().clone(), correlations: found };
        if !all.is_positive_definite() {
            let help = "make some of them smaller: inputs that go with the same third one go with each other";
            place.report("no inputs can have these correlations together: their matrix is not positive definite", Some(help.to_owned()));
            return None;
        }
        Some(all.correlations)
    }

    fn correlation(&self, field: Field<'_>, whole: bool) -> Option<InputCorrelation> {
        let key = field.path().to_owned();
        let items = field.items(ENTRY, 3..=3)?;
        let [one, other, coefficient] = <[Field<'_>; 3]>::try_from(items).ok()?;
        let pair = [one, other].map(|name| self.correlated(name, whole));
        let place = coefficient.clone();
        let coefficient = self.quantity(coefficient, Kind::PURE).filter(|coefficient| {
            let is_possible = coefficient.abs() < 1.0;
            if !is_possible {
                place.report(format!("it is {coefficient}; it must be between -1 and 1, both excluded"), percent_meant(*coefficient));
            }
            is_possible
        });
        let [one, other] = pair;
        Some(InputCorrelation { one: one?, other: other?, coefficient: coefficient?, key })
    }

    /// Reads the name of an uncertain input.
    fn correlated(&self, field: Field<'_>, whole: bool) -> Option<Parameter> {
        let place = field.clone();
        let name = field.string()?;
        let uncertain = self.uncertain.borrow();
        let named = Parameter::named(name);
        if named.is_some_and(|parameter| self.is_fitted(parameter)) {
            place.report("the tests that it is fitted to give its correlations", None);
            return None;
        }
        if let Some(parameter) = named.filter(|parameter| !whole || uncertain.iter().any(|input| input.parameter == *parameter)) {
            return Some(parameter);
        }
        let names: Vec<String> = uncertain.iter().map(|input| input.parameter.to_string()).collect();
        let known = || match names.is_empty() {
            true => "no input of this case is uncertain: give one as \"1500 kg \u{b1} 50 kg\"".to_owned(),
            false => format!("the uncertain inputs are {}", names.join(", ")),
        };
        let help = nearest(name, names.iter().map(String::as_str)).map(|name| format!("did you mean `{name}`?"));
        match named {
            Some(parameter) => place.report(format!("the case gives no uncertainty of {parameter}"), Some(known())),
            None => place.report("no input has this name", Some(help.unwrap_or_else(known))),
        }
        None
    }
}
