//! The coefficient of restitution of the contact.

use planar_impact::{Distribution, Input};

use super::CaseReader;
use crate::case::domain::Domain;
use crate::case::parameter::Parameter;
use crate::case::restitution::{CurvePoint, Restitution, RestitutionCurve};
use crate::case::uncertain::UncertainInput;
use crate::document::{Entry, Field, Table, Value};
use crate::quantity::Kind;
use crate::wording::count_of;

/// Maximum number of points of a curve.
const MOST_POINTS: usize = 1000;

/// The key that makes a table a curve.
const CLOSING_SPEED: &str = "closing_speed";

impl CaseReader {
    /// Reads a restitution that may be uncertain, or a curve over the closing speed.
    pub(super) fn restitution(&self, field: Field<'_>) -> Option<Restitution> {
        match field.value() {
            Some(Value::Table(entries)) if is_curve(entries) => {
                let key = format!("{}.sd", field.path());
                let table = field.table()?;
                let curve = self.curve(&table);
                table.finish();
                let curve = curve?;
                if curve.has_scatter() {
                    let distribution = Distribution::Normal { mean: 0.0, sd: 1.0 };
                    let parameter = Parameter::RestitutionScatter;
                    self.uncertain.borrow_mut().push(UncertainInput {
                        parameter,
                        key,
                        nominal: 0.0,
                        distribution,
                        values: None,
                        is_for_95: false,
                    });
                }
                Some(Restitution::OfClosingSpeed(curve))
            }
            _ => self.input(field, Parameter::Input(Input::Restitution)).map(Restitution::Given),
        }
    }

    fn curve(&self, table: &Table<'_>) -> Option<RestitutionCurve> {
        let speeds = self.points(table.required(CLOSING_SPEED), Kind::SPEED, Domain::NotNegative);
        let restitutions = self.points(table.required("restitution"), Kind::PURE, Domain::Fraction);
        let sds = self.sds(table);
        let speeds = speeds.filter(|speeds| makes_a_curve(&table.required(CLOSING_SPEED), speeds));
        let count = speeds.as_ref().map(Vec::len);
        let has_same_count = |key, values: &Vec<f64>| {
            let is_same = count.is_none_or(|count| count == values.len());
            if let (false, Some(count)) = (is_same, count) {
                let help = "give one for each closing speed".to_owned();
                table.required(key).report(format!("it has {} for {count} closing speeds", count_of(values.len(), "value")), Some(help));
            }
            is_same
        };
        let restitutions = restitutions.filter(|values| has_same_count("restitution", values));
        let sds = sds.filter(|sds| match sds {
            Sd::Same(_) => true,
            Sd::OfEach(values) => has_same_count("sd", values),
        });
        let (speeds, restitutions, sds) = (speeds?, restitutions?, sds?);
        let sd = |place: usize| match &sds {
            Sd::Same(sd) => *sd,
            Sd::OfEach(values) => values[place],
        };
        let point = |(place, (closing_speed, restitution)): (usize, (&f64, &f64))| CurvePoint {
            closing_speed: *closing_speed,
            restitution: *restitution,
            sd: sd(place),
        };
        Some(RestitutionCurve::new(speeds.iter().zip(&restitutions).enumerate().map(point).collect()))
    }

    /// Reads a number for each point.
    fn points(&self, field: Field<'_>, kind: Kind, domain: Domain) -> Option<Vec<f64>> {
        let items = field.items(&format!("an array of at least two values, each {}", kind.wanted()), 0..=MOST_POINTS)?;
        self.each(items, kind, domain)
    }

    fn sds(&self, table: &Table<'_>) -> Option<Sd> {
        let field = table.optional("sd");
        match field.value() {
            None => Some(Sd::Same(0.0)),
            Some(Value::Array(_)) => {
                let items = field.items(&format!("an array of values, each {}", Kind::PURE.wanted()), 0..=MOST_POINTS)?;
                self.each(items, Kind::PURE, Domain::Fraction).map(Sd::OfEach)
            }
            Some(_) => self.certain(field, Kind::PURE, Domain::Fraction).map(Sd::Same),
        }
    }
}

/// The standard deviation of the points of a curve.
enum Sd {
    Same(f64),
    OfEach(Vec<f64>),
}

fn is_curve(entries: &[Entry]) -> bool {
    entries.iter().any(|entry| [CLOSING_SPEED, "restitution"].contains(&entry.key.as_str()))
}

/// Returns `true` if there are two closing speeds or more, which increase; reports their lack, and each that does not.
fn makes_a_curve(field: &Field<'_>, speeds: &[f64]) -> bool {
    if speeds.len() < 2 {
        let help = "for a restitution at every closing speed give it alone: restitution = 0.2".to_owned();
        field.report(format!("a curve needs at least two points; it has {}", speeds.len()), Some(help));
        return false;
    }
    let mut increases = true;
    let items = field.clone().items("an array", 0..=MOST_POINTS).unwrap_or_default();
    let is_bare = |(item, speed): (&Field<'_>, &f64)| (*speed != 0.0).then(|| matches!(item.value(), Some(Value::Number(_))));
    let bare: Vec<bool> = items.iter().zip(speeds).filter_map(is_bare).collect();
    let has_mixed_units = bare.contains(&true) && bare.contains(&false);
    for (pair, item) in speeds.windows(2).zip(items.into_iter().skip(1)) {
        if pair[1] <= pair[0] {
            let help = match has_mixed_units {
                true => format!("write the unit of each: a closing speed without one is in {}", Kind::SPEED.si),
                false => "give the points in the order of their closing speeds, each once".to_owned(),
            };
            item.report("the closing speed is not above the one before it", Some(help));
            increases = false;
        }
    }
    increases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::issue::Issues;
    use crate::source::Source;

    fn read(restitution: &str) -> Result<Case, Issues> {
        let text = format!(
            "schema = 1\n[[vehicle]]\nmass = 1000\nyaw_inertia = 1500\nheading = 0\nspeed = 10\nimpact_center = [2, 0]\n\
             [[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = {restitution}\n"
        );
        Case::parse(Source::new("case.toml", text))
    }

    #[test]
    fn a_curve_is_read_with_its_scatter() {
        let kmh = 1.0 / 3.6;
        let with = |sds: [f64; 2], scatter| {
            let point = |speed: f64, restitution, sd| CurvePoint { closing_speed: speed * kmh, restitution, sd };
            let mut curve = RestitutionCurve::new(vec![point(18.0, 0.3, sds[0]), point(54.0, 0.1, sds[1])]);
            curve.scatter = scatter;
            Restitution::OfClosingSpeed(curve)
        };
        let points = "closing_speed = [\"18 km/h\", \"54 km/h\"], restitution = [\"30 %\", 0.1]";
        for (sd, wanted) in [("", [0.0; 2]), (", sd = 0", [0.0; 2]), (", sd = \"5 %\"", [0.05; 2]), (", sd = [0.1, 0]", [0.1, 0.0])] {
            let case = read(&format!("{{ {points}{sd} }}")).expect("a case");
            assert_eq!(case.inputs.contact.restitution, with(wanted, 0.0), "{sd}");
            // At 10 m/s, half way.
            assert!((case.collision.restitution - 0.2).abs() < 1e-15);
            let uncertain: Vec<(Parameter, &str)> =
                case.uncertain.inputs.iter().map(|input| (input.parameter, input.key.as_str())).collect();
            let scatter = vec![(Parameter::RestitutionScatter, "contact.restitution.sd")];
            assert_eq!(uncertain, if wanted == [0.0; 2] { Vec::new() } else { scatter }, "{sd}");
        }
    }

    #[test]
    fn a_curve_without_sense_is_refused_at_its_place() {
        for (curve, paths) in [
            ("{ closing_speed = [5, 5], restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed.2"][..]),
            ("{ closing_speed = [5, 3, 4], restitution = [0.3, 0.2, 0.1] }", &["contact.restitution.closing_speed.2"]),
            ("{ closing_speed = [5], restitution = [0.3] }", &["contact.restitution.closing_speed"]),
            ("{ closing_speed = [5], restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed"]),
            ("{ closing_speed = [5, 9], restitution = [0.3] }", &["contact.restitution.restitution"]),
            ("{ closing_speed = [], restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, -0.1] }", &["contact.restitution.restitution.2"]),
            ("{ closing_speed = [5, 9], restitution = [30, 0.1] }", &["contact.restitution.restitution.1"]),
            ("{ closing_speed = [-5, 9], restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed.1"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.2, 0.1] }", &["contact.restitution.restitution"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.1], sd = -0.1 }", &["contact.restitution.sd"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.1], sd = [0.1, -0.1] }", &["contact.restitution.sd.2"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.1], sd = [0.1, 0.1, 0.1] }", &["contact.restitution.sd"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.1], sd = \"1 m/s\" }", &["contact.restitution.sd"]),
            ("{ closing_speed = [\"5 kg\", 9], restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed.1"]),
            ("{ closing_speed = [5, 9] }", &["contact.restitution.restitution"]),
            ("{ restitution = [0.3, 0.1] }", &["contact.restitution.closing_speed"]),
            ("{ closing_speed = [5, 9], restitution = [0.3, 0.1], min = 0 }", &["contact.restitution.min"]),
            ("{ closing_speed = 5, restitution = 0.3 }", &["contact.restitution.closing_speed", "contact.restitution.restitution"]),
            (
                "{ closing_speed = [9, 5], restitution = [0.3, 2], sd = -1 }",
                &["contact.restitution.closing_speed.2", "contact.restitution.restitution.2", "contact.restitution.sd"],
            ),
        ] {
            let issues = read(curve).map(|_| ()).expect_err(curve);
            let mut found: Vec<&str> = issues.list().iter().map(|issue| issue.path.as_str()).collect();
            found.sort_unstable();
            assert_eq!(found, paths, "{curve}: {issues:?}");
            assert!(issues.list().iter().all(|issue| issue.span.is_some()), "{curve}: {issues:?}");
        }
    }
}
