//! Names of formulas: a name is known or refused; a formula's value in a case is what the code computes, and its derivative that of the dual numbers.

use planar_impact::Input;
use planar_impact_app::case::Parameter;
use planar_impact_app::formula::{self, Kind, Options};
use planar_impact_app::gradient::{self, Selection};
use planar_impact_app::{Case, Uncontrolled};

use crate::bytes::Bytes;
use crate::cases;

const OUTPUTS: [&str; 14] = ["W_n", "W_t", "T_L", "mu0", "dV1", "dV2", "P_n", "P_t", "V1x", "Omega2", "V_n", "V_t", "T_after", "P_x"];
const INPUTS: [&str; 12] = ["Gamma", "e", "mu", "m1", "m2", "I1", "I2", "theta1", "omega1", "v1x", "v2y", "d1"];

/// The target.
pub fn run(data: &[u8]) {
    let mut from = Bytes::new(data);
    let (output, input) =
        if from.chance(230) { (from.one_of(&OUTPUTS).to_owned(), from.one_of(&INPUTS).to_owned()) } else { (from.word(), from.key()) };
    let (Ok(of), wrt) = (formula::output(&output), formula::input(&input)) else { return };
    let derivative = from.chance(100);
    let tree = cases::case(&mut from);
    let text = tree.json();
    let Ok(case) = Case::parse(cases::source("case.json", text.clone())) else { return };
    let wrt = wrt.ok().filter(|_| derivative);
    let answer = match formula::formula(Some(&case), &Options { output: of, wrt, kind: Kind::default() }, &Uncontrolled) {
        Ok(answer) => answer,
        Err(issues) => return cases::sound_refusal(&issues),
    };
    let impact = case.impact().unwrap_or_else(|issues| panic!("{issues}"));
    let (open, close) = (answer.latex.matches('{').count(), answer.latex.matches('}').count());
    assert_eq!(open, close, "{}", answer.latex);
    let Some(found) = answer.definitions.first().and_then(|first| first.value) else { return };
    let (expected, size) = match answer.wrt {
        None => {
            let value = of.of(&case.collision, &impact);
            (value, value.abs() + scale(&impact))
        }
        Some(input) => {
            let parameter = Parameter::named(&input).expect("a name that `gradient` knows");
            let names = |name: &str| Selection::Named(vec![name.to_owned()]);
            let options = gradient::Options { of: names(of.name()), wrt: names(&input), second: false };
            let Ok(gradient) = gradient::gradient(&case, &options, &Uncontrolled) else { return };
            let value = serde_json::to_value(&gradient).expect("JSON");
            let Some(value) = value["of"][of.name()]["d"][input].as_f64() else { return };
            // A derivative loses what the condition of the case takes: those of vehicles are compared.
            // A case whose radius of gyration or speed is given moves more with a mass or a heading than the formula's own symbol.
            let is_moving_more = matches!(parameter, Parameter::Input(Input::Mass(_) | Input::Heading(_)));
            let is_own = case.inputs.keys().contains(&parameter) && !is_moving_more;
            if !is_own || !is_usual(&case, &impact) {
                return;
            }
            (value, value.abs() * 10.0 + scale(&impact) + 1.0)
        }
    };
    let share = (f64::EPSILON * leverage(&case).powi(2)).max(1e-7);
    assert!((found - expected).abs() <= share * size || !size.is_finite(), "{output} by {wrt:?}: {found:e}, not {expected:e}\n{text}");
}

/// The greatest d²/k² of the vehicles. What is left of a velocity at the contact that a yaw rate nearly cancels loses its square, in the formula and in the code.
fn leverage(case: &Case) -> f64 {
    let of = |vehicle: &planar_impact::Vehicle| vehicle.mass * vehicle.impact_center.length().powi(2) / vehicle.yaw_inertia;
    case.collision.parties().iter().filter_map(|party| party.vehicle()).map(of).fold(1.0, f64::max)
}

/// Two vehicles, or one and a barrier, of usual sizes that meet at more than a walk.
fn is_usual(case: &Case, impact: &planar_impact::Impact) -> bool {
    let is_usual = |vehicle: &planar_impact::Vehicle| {
        let arm = vehicle.impact_center.length();
        (100.0..1e5).contains(&vehicle.mass) && (0.1..10.0).contains(&(vehicle.yaw_inertia / vehicle.mass)) && arm < 5.0
    };
    impact.approach.n.abs() > 1.0 && case.collision.parties().iter().filter_map(|party| party.vehicle()).all(is_usual)
}

fn scale(impact: &planar_impact::Impact) -> f64 {
    let speeds = impact.approach.length() + impact.separation.length();
    speeds + impact.impulse.length() * (1.0 + speeds) + impact.kinetic_energy.before
}
