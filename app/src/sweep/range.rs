//! Ranges of inputs, such as `contact.crush_plane=-10 deg:10 deg:1 deg`.

use planar_impact::Input;

use crate::case::{Inputs, Parameter};
use crate::issue::Issue;
use crate::names;
use crate::quantity::{self, Conversion, Quantity, QuantityError, excerpt};

/// Maximum number of points of a sweep.
pub const MOST_POINTS: usize = 1_000_000;

/// The values of one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The input.
    pub parameter: Parameter,
    /// The unit of [`Range::shown`], which is the first unit of the range.
    pub unit: String,
    /// `true` if the unit is assumed, because the range has none.
    pub is_unit_assumed: bool,
    /// The values in that unit.
    pub shown: Vec<f64>,
    /// The values in SI.
    pub si: Vec<f64>,
}

impl Range {
    /// Parses one range for a case.
    fn read(text: &str, inputs: &Inputs) -> Result<Range, Vec<Issue>> {
        let issue = |message: &str, help: Option<String>| vec![names::issue("--vary", text, message, help)];
        let Some((name, range)) = text.split_once('=') else {
            let example = "as in --vary \"contact.crush_plane=-10 deg:10 deg:1 deg\"".to_owned();
            return Err(issue("expected NAME=FROM:TO:STEP", Some(example)));
        };
        let name = name.trim();
        let parameter = names::parameter("--vary", name, inputs).map_err(|issue| vec![issue])?;
        let issue = |message: &str, help| vec![names::issue("--vary", name, message, help)];
        inputs.can_set(parameter).map_err(|why| issue(&why, None))?;
        if let Some((message, help)) = moves_across(parameter, inputs) {
            return Err(issue(&message, Some(help)));
        }
        let parts: Vec<&str> = range.split(':').collect();
        let &[from, to, step] = &parts[..] else {
            let message = format!("expected FROM:TO:STEP; found {}", excerpt(range));
            return Err(issue(&message, Some("give the first value, the last value and the step, with colons between them".to_owned())));
        };
        let (kind, wrong) = (parameter.kind(), |error: QuantityError| names::issue("--vary", name, &error.message, error.help));
        let ends = [from, to].map(|end| quantity::parse_word(end, kind).map_err(wrong));
        let step = quantity::parse_word(step, kind.difference()).map_err(wrong);
        let (from, to, step) = match (ends, step) {
            ([Ok(from), Ok(to)], Ok(step)) => (from, to, step),
            ([from, to], step) => {
                let mut wrong: Vec<Issue> = [from.err(), to.err(), step.err()].into_iter().flatten().collect();
                // Of numbers without a unit, each would be given that of its own remedy, and be refused beside the others.
                if let (Some(help), Some(first)) = (with_likely_unit(name, &parts, kind), wrong.first_mut()) {
                    first.help = Some(help.into());
                    wrong.truncate(1);
                }
                return Err(wrong);
            }
        };
        if let Some((message, help)) = some_without_unit(name, [&from, &to, &step].into_iter().zip(&parts)) {
            return Err(issue(&message, help));
        }
        let outside = |end: &Quantity| {
            let wanted = parameter.domain().wanted(end.si)?;
            Some(names::issue("--vary", name, &format!("{} {}; it must be {wanted}", end.value, end.unit).replace(" ;", ";"), None))
        };
        let outside: Vec<Issue> = [&from, &to].into_iter().filter_map(outside).collect();
        if !outside.is_empty() {
            return Err(outside);
        }
        if let Some((message, help)) = wrong_step(&from, &to, &step) {
            return Err(issue(&message, help));
        }
        Range::between(parameter, &from, &to, &step).map_err(|error| issue(&error.message, error.help))
    }

    /// Computes the values from one end of a range, including the other end if it is a whole number of steps away.
    fn between(parameter: Parameter, from: &Quantity, to: &Quantity, step: &Quantity) -> Result<Range, QuantityError> {
        let unit = from.unit.clone();
        let conversion = Conversion::of(&unit, parameter.kind())?;
        let in_unit = |quantity: &Quantity| if quantity.unit == unit { quantity.value } else { conversion.of_si(quantity.si) };
        let (first, last, step) = (from.value, in_unit(to), in_unit(step));
        let steps = if last == first { 0.0 } else { (last - first) / step };
        let whole = (steps - steps.round()).abs() <= 1e-9 * steps.max(1.0);
        let count = if whole { steps.round() } else { steps.floor() };
        if count.is_nan() || count >= MOST_POINTS as f64 {
            let steps = if count < 1e15 { format!("{count:.0}") } else { format!("{count:.1e}") };
            return Err(QuantityError { message: format!("{steps} steps exceed the limit of a sweep"), help: too_many() });
        }
        let scale = decimal_scale([first, step]);
        let value = |i: usize| match (i as f64, scale) {
            (i, _) if whole && i == count => last,
            (i, Some(scale)) => ((first * scale).round() + i * (step * scale).round()) / scale,
            (i, None) => first + i * step,
        };
        // The check above ensures a whole number below the maximum number of points.
        let shown: Vec<f64> = (0..=count as usize).map(value).collect();
        let si = shown.iter().map(|&value| conversion.to_si(value)).collect();
        Ok(Range {
            parameter,
            is_unit_assumed: from.bare && to.bare && !unit.is_empty() && (from.value, to.value) != (0.0, 0.0),
            unit,
            shown,
            si,
        })
    }
}

/// Parses every range of a call.
pub fn read(texts: &[String], inputs: &Inputs, issues: &mut Vec<Issue>) -> Vec<Range> {
    let mut ranges: Vec<Range> = Vec::new();
    for text in texts {
        match Range::read(text, inputs) {
            Ok(range) => ranges.push(range),
            Err(found) => issues.extend(found),
        }
    }
    if texts.len() > 2 {
        let message = format!("{} inputs are varied; one or two can be", texts.len());
        issues.push(Issue::of_call("--vary", message, None));
    }
    if let [one, two] = &ranges[..] {
        if let Some(message) = conflict(one.parameter, two.parameter) {
            issues.push(Issue::of_call("--vary", message, None));
        }
        if one.si.len().saturating_mul(two.si.len()) > MOST_POINTS {
            let message = format!("{} times {} points exceed the limit of a sweep", one.si.len(), two.si.len());
            issues.push(Issue::of_call("--vary", message, too_many()));
        }
    }
    ranges
}

/// Refuses a speed of a vehicle whose velocity has a component across its heading: a row of `batch` and a case file take a speed for the whole velocity, and a
/// point of a sweep would keep that component.
fn moves_across(parameter: Parameter, inputs: &Inputs) -> Option<(String, String)> {
    let Parameter::Speed(side) = parameter else { return None };
    inputs.vehicles[side as usize].as_ref().filter(|vehicle| vehicle.moves_across())?;
    let message = "the velocity of the case has a component across the heading, and a speed has none".to_owned();
    let help = format!("vary `{}` and `{}`, or give the vehicle a `speed` in the case", Input::VelocityX(side), Input::VelocityY(side));
    Some((message, help))
}

fn too_many() -> Option<String> {
    Some(format!("the most is {MOST_POINTS} points; take a larger step"))
}

/// Returns the remedy of a range without units whose numbers were probably meant in another unit than that of SI.
fn with_likely_unit(name: &str, parts: &[&str], kind: quantity::Kind) -> Option<String> {
    let unit = kind.likely.first()?;
    let whole: Vec<String> = parts.iter().map(|part| format!("{} {unit}", part.trim())).collect();
    let is_bare = parts.iter().all(|part| quantity::unit_of(part).is_some_and(|(_, unit)| unit.is_empty()));
    let is_read = whole.iter().all(|part| quantity::parse_word(part, kind.difference()).is_ok());
    (is_bare && is_read).then(|| format!("write the unit of each, as in {name}={}", whole.join(":")))
}

/// Returns the message and the help for a range in which only some of the three numbers have a unit; a zero needs none.
fn some_without_unit<'a>(name: &str, parts: impl Iterator<Item = (&'a Quantity, &'a &'a str)>) -> Option<(String, Option<String>)> {
    let parts: Vec<(&Quantity, &str)> = parts.map(|(quantity, text)| (quantity, text.trim())).collect();
    let has_unit = |quantity: &Quantity| !quantity.bare && !quantity.unit.is_empty();
    let unit = &parts.iter().find(|(quantity, _)| has_unit(quantity))?.0.unit;
    let (_, without) = parts.iter().find(|(quantity, _)| !has_unit(quantity) && quantity.value != 0.0)?;
    let mut whole: Vec<String> =
        parts.iter().map(|(quantity, text)| if has_unit(quantity) { (*text).to_owned() } else { format!("{text} {unit}") }).collect();
    if let [(from, _), (to, _), (step, _)] = parts[..]
        && (to.value - from.value) * step.value < 0.0
    {
        whole[2] = whole[2].strip_prefix('-').map_or_else(|| format!("-{}", whole[2]), str::to_owned);
    }
    let help = match unit.as_str() {
        // A fraction or a number of hundredths.
        "%" => "write `%` behind each of the three numbers, or behind none".to_owned(),
        _ => format!("write the unit of each: {name}={}", whole.join(":")),
    };
    Some((format!("{} has no unit, and others of FROM:TO:STEP have one", excerpt(without)), Some(help)))
}

fn wrong_step(from: &Quantity, to: &Quantity, step: &Quantity) -> Option<(String, Option<String>)> {
    if step.si == 0.0 {
        return Some(("the step is zero".to_owned(), None));
    }
    let length = to.si - from.si;
    let backwards = length * step.si < 0.0;
    let turned = if step.value < 0.0 { format!("{}", -step.value) } else { format!("-{}", step.value) };
    let help = format!("write the step as {turned} {}", step.unit);
    if backwards {
        return Some(("the step leads away from the last value".to_owned(), Some(help.trim_end().to_owned())));
    }
    let help = "the step is the distance of a value from the next, and not their number; for one value, write it as FROM and as TO";
    (length != 0.0 && step.si.abs() > length.abs() * (1.0 + 1e-9))
        .then(|| ("the step leads beyond the last value".to_owned(), Some(help.to_owned())))
}

/// Describes a conflict of two inputs that are equivalent or exclude each other.
fn conflict(one: Parameter, two: Parameter) -> Option<String> {
    if one == two {
        return Some(format!("`{one}` is varied twice"));
    }
    one.excludes(two).then(|| format!("`{one}` and `{two}` are two names of one input; vary one of them"))
}

/// Returns a power of ten that makes all these numbers whole, so that their sums print as a person writes them: 0.3,
/// not 0.30000000000000004.
fn decimal_scale(numbers: [f64; 2]) -> Option<f64> {
    let whole_at = |scale: f64| {
        numbers.iter().all(|x| {
            let scaled = (x * scale).round();
            scaled.abs() < 1e14 && scaled / scale == *x
        })
    };
    (0..=12).map(|digits| libm::exp10(f64::from(digits))).find(|&scale| whole_at(scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::source::Source;

    fn case() -> Case {
        let text = include_str!("../../../cli/examples/position-a.toml").to_owned();
        Case::parse(Source::new("case.toml", text)).expect("the example is sound")
    }

    fn read_one(text: &str) -> Result<Range, String> {
        let mut issues = Vec::new();
        let ranges = read(&[text.to_owned()], &case().inputs, &mut issues);
        let told = |issue: &Issue| {
            let help = issue.help.as_ref().map(ToString::to_string).unwrap_or_default();
            format!("{}: {} {help}", issue.path, issue.message)
        };
        if issues.is_empty() { Ok(ranges[0].clone()) } else { Err(issues.iter().map(told).collect::<Vec<_>>().join("\n")) }
    }

    #[test]
    fn values_are_those_that_a_person_writes() {
        let range = read_one("e=0:0.3:0.1").expect("a range");
        assert_eq!(range.shown, [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(range.si, range.shown);
        let range = read_one("contact.crush_plane=-10 deg:10 deg:1 deg").expect("a range");
        assert_eq!((range.shown.len(), range.shown[10], range.si[10]), (21, 0.0, 0.0));
        // Bit for bit the value of `crush_plane = "7 deg"`.
        assert_eq!(range.si[17], quantity::parse("7 deg", range.parameter.kind()).expect("an angle").si);
        assert_eq!(read_one("Gamma=0:1:0.25").expect("a range").unit, "rad");
        assert_eq!(read_one("e=15 %:30 %:5 %").expect("a range").si, [0.15, 0.2, 0.25, 0.3]);
    }

    #[test]
    fn the_last_value_is_hit_only_by_whole_steps() {
        assert_eq!(read_one("e=0:1:0.3").expect("a range").shown, [0.0, 0.3, 0.6, 0.9]);
        assert_eq!(read_one("e=0:1:0.4").expect("a range").shown, [0.0, 0.4, 0.8]);
        assert_eq!(read_one("e=1:0:-0.5").expect("a range").shown, [1.0, 0.5, 0.0]);
        assert_eq!(read_one("e=0.2:0.2:0.1").expect("a range").shown, [0.2]);
        let third = read_one("e=0:1:0.3333333333333333").expect("a range");
        assert_eq!((third.shown.len(), third.shown[3]), (4, 1.0));
        let mixed = read_one("v1=0:30 mph:5 mph").expect("a range");
        assert_eq!((mixed.unit.as_str(), mixed.shown.len()), ("m/s", 7));
        assert_eq!(mixed.si[6], mixed.shown[6]);
        assert_eq!(
            read_one("e=0:1:0.000001").unwrap_err(),
            "--vary e: 1000000 steps exceed the limit of a sweep the most is 1000000 points; take a larger step"
        );
        assert_eq!(read_one("e=0:1:0.000002").expect("a range").shown.len(), 500_001);
    }

    #[test]
    fn wrong_ranges() {
        for (text, says) in [
            ("Gamma", "--vary Gamma: expected NAME=FROM:TO:STEP"),
            ("", "--vary: expected NAME=FROM:TO:STEP"),
            ("contact.crush_plan=0:1:0.1", "unknown input did you mean `contact.crush_plane`?"),
            ("yaw_rate=0:1:1", "unknown input did you mean `vehicle.1.yaw_rate` or `vehicle.2.yaw_rate`?"),
            ("W_n=0:1:0.1", "this is an output, not an input"),
            ("Gamma=0 deg:1 deg", "expected FROM:TO:STEP; found `0 deg:1 deg`"),
            ("Gamma=0 deg:1 deg:1 deg:1 deg", "expected FROM:TO:STEP"),
            ("Gamma=0 deg:1 ft:1 kg", "`1 ft` is a length; an angle is expected, such as \"-10 deg\" \n--vary Gamma: `1 kg` is a mass"),
            ("Gamma=-10:10:1", "1.59 turns write the unit of each, as in Gamma=-10 deg:10 deg:1 deg"),
            ("theta1=0:6.3:1", "write the unit of each, as in theta1=0 deg:6.3 deg:1 deg"),
            ("e=0:1:1e-300", "1.0e300 steps exceed"),
            ("Gamma=0 deg:1 deg:0 deg", "the step is zero"),
            ("Gamma=0 deg:0 deg:0 deg", "the step is zero"),
            ("Gamma=0 deg:1 deg:-1 deg", "the step leads away from the last value write the step as 1 deg"),
            ("e=1:0:0.1", "write the step as -0.1"),
            ("e=0:1:11", "the step leads beyond the last value the step is the distance"),
            ("Gamma=10 deg:-10 deg:-21 deg", "the step leads beyond the last value"),
            ("e=-0.1:1.5:0.1", "--vary e: -0.1; it must be from 0 to 1 \n--vary e: 1.5; it must be from 0 to 1"),
            ("m1=0 kg:100 kg:1 kg", "0 kg; it must be above zero"),
            ("k1=1 m:2 m:1 m", "the case gives `yaw_inertia` instead"),
            ("vehicle.1.crush.d0=1:2:1", "the vehicle has no crush in this case"),
            ("v1=0:20:5 mph", "`20` has no unit, and others of FROM:TO:STEP have one write the unit of each: v1=0 mph:20 mph:5 mph"),
            ("v1=40:20 mph:5 mph", "`40` has no unit, and others of FROM:TO:STEP have one write the unit of each: v1=40 mph:20 mph:-5 mph"),
            ("v1=10 mph:20 mph:5", "`5` has no unit, and others of FROM:TO:STEP have one write the unit of each: v1=10 mph:20 mph:5 mph"),
            (
                "e=0:30 %:5",
                "`5` has no unit, and others of FROM:TO:STEP have one write `%` behind each of the three numbers, or behind none",
            ),
            ("e=0:nan:0.1", "not a finite number"),
            ("e=::", "the string is empty"),
        ] {
            let told = read_one(text).expect_err(text);
            assert!(told.contains(says), "{text}: {told}");
        }
    }

    #[test]
    fn two_inputs_must_not_say_the_same() {
        let told = |texts: &[&str]| {
            let mut issues = Vec::new();
            read(&texts.iter().map(|&text| text.to_owned()).collect::<Vec<_>>(), &case().inputs, &mut issues);
            issues.iter().map(|issue| issue.message.to_string()).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(told(&["e=0:1:0.5", "Gamma=0:1:0.5"]), "");
        assert_eq!(told(&["vehicle.1.velocity.x=0:1:1", "vehicle.1.velocity.y=0:1:1"]), "");
        assert_eq!(told(&["v1=0:1:1", "vehicle.2.velocity.y=0:1:1"]), "");
        assert!(told(&["e=0:1:0.5", "e=0:1:0.25"]).contains("varied twice"));
        assert!(told(&["vehicle.1.velocity.y=0:1:1", "v1=0:1:1"]).contains("two names of one input"));
        assert!(told(&["mu=0:1:1", "contact.friction=0:1:1"]).contains("two names of one input"));
        assert!(told(&["e=0:1:0.5", "Gamma=0:1:0.5", "v1=0:1:1"]).contains("one or two can be"));
        assert!(told(&["e=0:1:0.0001", "Gamma=0:1:0.0001"]).contains("10001 times 10001 points"));
    }
}
