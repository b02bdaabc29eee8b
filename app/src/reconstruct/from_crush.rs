//! Uncertainty of crush energies from that of the crush, to first order.

use planar_impact::Side;
use planar_impact::num_dual::Dual64;
use planar_impact::reconstruct::{Correlation, Measurand, Uncertainty};

use super::crush_bend::{CrushBend, crush_energy};
use super::inputs::without_deviation;
use crate::case::{Case, Known, Parameter, Uncertain, correlation_of};
use crate::issue::Issue;
use crate::message::Message;
use crate::notice::Notice;
use crate::units::Measure;

/// Crush energies of the evidence with the uncertainty of the crush that they are taken from.
#[derive(Default)]
pub struct FromCrush {
    /// Correlations of crush energies that depend on the same or on correlated numbers.
    pub correlations: Vec<Correlation>,
    /// The uncertain numbers of the crush that the evidence does not depend on.
    pub unused: Vec<Parameter>,
    /// The energies whose errors are those of depths: their roots grow more evenly with what is uncertain than themselves.
    pub from_depths: Vec<Measurand>,
    /// Explanations.
    pub notices: Vec<Notice>,
    /// Uncertain numbers of the crush that have no standard deviation.
    pub issues: Vec<Issue>,
}

impl FromCrush {
    /// Adds the uncertainty of the crush to the evidence of a case that is taken from it.
    pub fn of(case: &mut Case) -> Self {
        let mut found = FromCrush::default();
        let crush: Vec<Parameter> = case
            .uncertain
            .inputs
            .iter()
            .map(|input| input.parameter)
            .filter(|parameter| matches!(parameter, Parameter::Crush(..)))
            .collect();
        if !crush.is_empty() {
            found.notices.extend(leave_out_total(&mut case.knowledge.evidence));
        }
        let slopes: Vec<Option<Vec<f64>>> = case.knowledge.evidence.iter().map(|known| slopes(case, known, &crush)).collect();
        let is_used = |i: usize| slopes.iter().flatten().any(|slopes| slopes[i] != 0.0);
        found.unused = (0..crush.len()).filter(|&i| !is_used(i)).map(|i| crush[i]).collect();
        let used = (0..crush.len()).filter(|&i| is_used(i)).filter_map(|i| case.uncertain.of(crush[i]));
        found.issues = used.filter_map(without_deviation).collect();
        if !found.issues.is_empty() {
            return found;
        }
        let uncertain = &case.uncertain;
        let covariance = |one: &[f64], other: &[f64]| covariance(uncertain, &crush, one, other);
        let mut deviations = vec![0.0; slopes.len()];
        for (i, known) in case.knowledge.evidence.iter_mut().enumerate() {
            let Some(slopes) = &slopes[i] else { continue };
            let of_crush = covariance(slopes, slopes).sqrt();
            if of_crush == 0.0 {
                continue;
            }
            let own = known.uncertainty.standard_deviation().unwrap_or(0.0);
            deviations[i] = libm::hypot(own, of_crush);
            known.uncertainty = Uncertainty::StandardDeviation(deviations[i]);
            let mut message = Message::from(format!("{}: the uncertain crush gives it a standard deviation of ", known.of.name()))
                .figure(Measure::Energy, of_crush);
            if own > 0.0 {
                message = message.text(", and with its own it is ").figure(Measure::Energy, deviations[i]);
            }
            found.notices.push(Notice::note("uncertainty-from-crush", known.key.clone(), message));
            let bend = CrushBend::of(&case.inputs, uncertain, known.of, &crush, slopes, own);
            if bend.has_straighter_root {
                found.from_depths.push(known.of);
            }
            found.notices.extend(bends(known, of_crush, bend.excess));
        }
        for (i, one) in case.knowledge.evidence.iter().enumerate() {
            for (k, other) in case.knowledge.evidence.iter().enumerate().skip(i + 1) {
                let (Some(of_one), Some(of_other)) = (&slopes[i], &slopes[k]) else { continue };
                let shared = covariance(of_one, of_other);
                found.correlations.extend(correlation_of([one.of, other.of], shared, [deviations[i], deviations[k]]));
            }
        }
        found
    }
}

/// Returns a warning of a crush energy whose errors are far from normal, also by its root.
fn bends(known: &Known, of_crush: f64, excess: f64) -> Option<Notice> {
    /// Share of the standard deviation of which an interval of 95 % still contains the truth in 94 %.
    const STRAIGHT: f64 = 0.25;
    let message = || {
        let (more, too) = if excess > 0.0 { ("more", "high") } else { ("less", "low") };
        Message::from(format!("{}: ", known.of.name()))
            .figure(Measure::Energy, known.value)
            .text(" ± ")
            .figure(Measure::Energy, of_crush)
            .text(" is on average ")
            .figure(Measure::Energy, excess.abs())
            .text(format!(" {more} than that of the crush without its errors: intervals may lie too {too}; measure the crush better"))
    };
    (excess.abs() > STRAIGHT * of_crush).then(|| Notice::warning("crush-bends", known.key.clone(), message()))
}

/// Leaves out the total crush energy beside those of both vehicles if all three are taken from the crush and have the uncertainty of nothing else: it is their sum, and
/// would make their covariance singular.
fn leave_out_total(evidence: &mut Vec<Known>) -> Option<Notice> {
    let bare =
        |of: Measurand| evidence.iter().position(|known| known.of == of && known.is_from_crush && known.uncertainty == Uncertainty::Exact);
    let total = bare(Measurand::CrushEnergy)?;
    Side::ALL.iter().all(|side| bare(Measurand::CrushEnergyOf(*side)).is_some()).then(|| {
        let message = "crush_energy is the sum of the crush energies of both vehicles, which are taken from the same crush: it adds nothing, and is left out";
        Notice::note("total-left-out", evidence.remove(total).key, message)
    })
}

/// Returns the derivatives of a crush energy by uncertain numbers, or `None` if the evidence is not taken from the crush.
fn slopes(case: &Case, known: &Known, crush: &[Parameter]) -> Option<Vec<f64>> {
    if !known.is_from_crush || crush.is_empty() {
        return None;
    }
    let slope = |of: &Parameter| {
        let by = |parameter| Dual64::new(0.0, if parameter == *of { 1.0 } else { 0.0 });
        crush_energy(&case.inputs, known.of, by).eps
    };
    Some(crush.iter().map(slope).collect())
}

/// Returns the covariance of two numbers with the given derivatives by uncertain parameters; that by the friction of `[rest]` is the change by one of its standard
/// deviations.
pub(super) fn covariance(uncertain: &Uncertain, parameters: &[Parameter], one: &[f64], other: &[f64]) -> f64 {
    let sd = |parameter: Parameter| match parameter {
        Parameter::RestFriction => 1.0,
        _ => uncertain.of(parameter).map_or(0.0, |input| input.distribution.sd()),
    };
    let mut sum = 0.0;
    // An input that neither depends on may have an infinite standard deviation.
    let counts = |slope: &f64| *slope != 0.0;
    for (a, i) in parameters.iter().zip(one).filter(|(_, slope)| counts(slope)) {
        for (b, k) in parameters.iter().zip(other).filter(|(_, slope)| counts(slope)) {
            sum += i * k * sd(*a) * sd(*b) * uncertain.correlation(*a, *b);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;

    /// Two vehicles of constant depths, whose crush energy is w (d0 + d1 C)²/2.
    fn case(correlation: &str, evidence: &str) -> Case {
        case_of("\"1.5 m ± 0.1 m\"", correlation, evidence)
    }

    /// The same with another width.
    fn case_of(width: &str, correlation: &str, evidence: &str) -> Case {
        let vehicle = |heading: &str, slope: &str| {
            format!(
                "[[vehicle]]\nmass = 1000\nyaw_inertia = 1500\nheading = {heading}\nspeed = 10\nimpact_center = [2, 0]\n\
                 [vehicle.crush]\nwidth = {width}\ndepths = [0.2, 0.2]\nstiffness = {{ d0 = 90, d1 = {slope} }}\n"
            )
        };
        let [one, two] = [vehicle("0", "\"700 N^0.5/m ± 35 N^0.5/m\""), vehicle("3.1", "{ min = 600, max = 900 }")];
        let text = format!(
            "schema = 1\ncorrelation = [{correlation}]\n{one}{two}[contact]\ncrush_plane = 0\nrestitution = 0\n[evidence]\n{evidence}"
        );
        Case::parse(Source::new("case.toml", text)).expect("a case")
    }

    fn close(got: f64, want: f64) {
        assert!((got - want).abs() < 1e-12 * want.abs(), "{got} {want}");
    }

    #[test]
    fn crush_energies_with_a_common_cause_are_correlated() {
        let evidence = "vehicle.1.crush_energy = \"from crush\"\nvehicle.2.crush_energy = \"from crush ± 3 kJ\"";
        let mut case = case("[\"vehicle.1.crush.d1\", \"vehicle.2.crush.d1\", 0.5]", evidence);
        let found = FromCrush::of(&mut case);
        // dE/dw = (d0 + d1 C)²/2 and dE/dd1 = w (d0 + d1 C) C, with d1 of 700 and 750; a uniform number has its width over √12.
        let energies = [700.0, 750.0].map(|slope| 90.0 + slope * 0.2);
        let by_width = energies.map(|root: f64| 0.1 * root * root / 2.0);
        let by_slope = [energies[0] * 1.5 * 0.2 * 35.0, energies[1] * 1.5 * 0.2 * 300.0 / 12_f64.sqrt()];
        let sd = [by_width[0].hypot(by_slope[0]), by_width[1].hypot(by_slope[1]).hypot(3e3)];
        for (known, sd) in case.knowledge.evidence.iter().zip(sd) {
            close(known.uncertainty.standard_deviation().expect("it is uncertain"), sd);
        }
        let [Correlation { one, other, coefficient }] = found.correlations[..] else { panic!("{:?}", found.correlations) };
        assert_eq!((one, other), (Measurand::CrushEnergyOf(Side::One), Measurand::CrushEnergyOf(Side::Two)));
        close(coefficient, 0.5 * by_slope[0] * by_slope[1] / (sd[0] * sd[1]));
        assert_eq!((found.unused, found.notices.len()), (vec![], 2));
        // Of the first most of the variance comes from the width, with which the energy grows evenly; of the second from d1, with which its root does.
        assert_eq!(found.from_depths, [Measurand::CrushEnergyOf(Side::Two)]);
    }

    #[test]
    fn an_excess_in_either_direction_is_named() {
        let known = Known {
            of: Measurand::CrushEnergy,
            key: "crush_energy".to_owned(),
            value: 4e4,
            uncertainty: Uncertainty::StandardDeviation(1e4),
            is_from_crush: true,
        };
        let message = |excess| bends(&known, 1e4, excess).map(|notice| notice.message.to_string());
        assert_eq!([2.4e3, -2.4e3].map(message), [None, None]);
        let [high, low] = [2.6e3, -2.6e3].map(|excess| message(excess).expect("a warning"));
        assert!(high.contains("2600 J more than") && high.contains("too high"), "{high}");
        assert!(low.contains("2600 J less than") && low.contains("too low"), "{low}");
    }

    #[test]
    fn an_infinite_standard_deviation_of_the_crush_matters_where_it_is_used() {
        let given = |evidence: &str| case_of("{ mean = 1.5, sd = 0.1, n = 3 }", "", evidence);
        let paths = |found: &FromCrush| found.issues.iter().map(|issue| issue.path.clone()).collect::<Vec<_>>();
        let mut of_both = given("crush_energy = \"from crush\"");
        assert_eq!(paths(&FromCrush::of(&mut of_both)), ["vehicle.1.crush.width", "vehicle.2.crush.width"]);
        let mut of_one = given("vehicle.1.crush_energy = \"from crush\"");
        assert_eq!(paths(&FromCrush::of(&mut of_one)), ["vehicle.1.crush.width"]);
        let mut of_none = given("vehicle.1.separation_yaw_rate = \"1 rad/s ± 0.1 rad/s\"");
        assert_eq!(paths(&FromCrush::of(&mut of_none)), [""; 0]);
    }

    #[test]
    fn numbers_that_no_evidence_takes_from_the_crush_are_named() {
        let mut case = case("", "vehicle.2.crush_energy = \"from crush\"");
        let found = FromCrush::of(&mut case);
        let unused: Vec<String> = found.unused.iter().map(ToString::to_string).collect();
        assert_eq!(unused, ["vehicle.1.crush.width", "vehicle.1.crush.d1"]);
        assert!(found.correlations.is_empty());
    }
}
