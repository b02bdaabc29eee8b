//! Reports refusals of the library at the keys of a file.

use planar_impact::post_impact::NoRest;
use planar_impact::{Measure, Message, Part, Refusal, Refusals};

use crate::issue::Issue;

/// Converts an issue of the library.
pub fn library_issue(issue: &impl planar_impact::Issue<Number = f64>) -> Issue {
    let path = issue.path().unwrap_or_default().into_owned();
    Issue { help: issue.help(), ..Issue::at(issue.code(), path, issue.message()) }
}

/// Reports a refusal at the key that can fix it.
pub fn refusal(refusal: &Refusal) -> Issue {
    let issue = library_issue(refusal);
    if refusal.is_physical() { Issue { message: without_rounding(&issue.message), ..issue } } else { issue }
}

/// Joins all reasons of a refusal in one sentence.
pub fn reasons(refusals: &Refusals) -> Message {
    joined(refusals.iter().map(|reason| refusal(reason).message))
}

/// Joins reasons in one sentence.
pub fn joined(reasons: impl Iterator<Item = Message>) -> Message {
    reasons.enumerate().fold(Message::new(), |all, (i, reason)| if i > 0 { all.text("; ").join(reason) } else { all.join(reason) })
}

/// Joins the codes of a refusal, each once, with `;`.
pub fn codes(refusals: &Refusals) -> String {
    let mut codes: Vec<&str> = refusals.iter().map(|reason| reason.code()).collect();
    codes.dedup();
    codes.join(";")
}

/// Replaces rounding errors with zero: negligible next to one meter or one meter per second.
fn without_rounding(message: &Message) -> Message {
    message.parts().iter().fold(Message::new(), |all, part| match part {
        Part::Text(text) => all.text(text.clone()),
        Part::Figure { measure: Measure::Ratio, value } => all.figure(Measure::Ratio, *value),
        Part::Figure { measure, value } => all.figure(*measure, if value.abs() <= 1e-12 { 0.0 } else { *value }),
        _ => all,
    })
}

/// Returns a hint for a missing mass of a vehicle: a barrier may be meant.
pub fn barrier_instead(path: &str) -> Option<String> {
    let (vehicle, key) = path.rsplit_once('.')?;
    let is_mass_of_vehicle = matches!(vehicle, "vehicle.1" | "vehicle.2") && ["mass", "weight"].contains(&key);
    is_mass_of_vehicle.then(|| "a fixed barrier is a [[vehicle]] with `barrier = true`".to_owned())
}

/// Returns what may bring a vehicle to rest.
pub fn remedy_of_no_rest(why: &NoRest) -> &'static str {
    match why {
        NoRest::NotFollowed(_) => "check the motion at separation: no vehicle is that fast, or turns that fast",
        NoRest::RollsBack(_) => "check `grade`, which is positive uphill; give brakes, a rolling resistance or a friction that hold on it",
        _ => "give it brakes or a rolling resistance, or more friction if its wheels are locked; on a grade, more than the grade",
    }
}

/// What to do where no slide was found that ends in the rest position.
pub const NO_SLIDE_FOUND: &str = "check the heading at rest, whole turns counted, and which wheels are locked; where wheels roll, the search \
may miss a slide that exists: give the separation velocity as evidence instead";

/// Returns a number of degrees of freedom in words.
pub fn degrees_of_freedom(count: usize) -> String {
    if count == 1 { "1 degree of freedom".to_owned() } else { format!("{count} degrees of freedom") }
}

/// Returns a number of things in words.
pub fn count_of(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Returns the message of a row of a table that has more cells or fewer than there are columns.
pub fn ragged(cells: usize, columns: usize) -> String {
    let comma = if cells > columns { "; a decimal comma?" } else { "" };
    format!("the row has {}, and the table has {}{comma}", count_of(cells, "cell"), count_of(columns, "column"))
}

/// Returns a hint for a coefficient far above 1: a percentage may be meant.
pub fn percent_meant(value: f64) -> Option<String> {
    (5.0..=100.0).contains(&value).then(|| format!("did you mean \"{value} %\"?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_barrier_is_meant_by_a_vehicle_without_a_mass_alone() {
        let is_hinted =
            ["vehicle.1.mass", "vehicle.2.weight", "vehicle.2.speed", "vehicle.3.mass", "mass"].map(|path| barrier_instead(path).is_some());
        assert_eq!(is_hinted, [true, true, false, false, false]);
    }
}
