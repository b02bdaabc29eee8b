//! Each row is the case file that it stands for.

use std::collections::{BTreeMap, BTreeSet};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::control::Uncontrolled;
use crate::gradient::{self, Selection};
use crate::source::Source;

/// One row as cells, and as the keys of a case file.
#[derive(Clone, Default)]
struct Written {
    cells: Vec<(&'static str, String)>,
    vehicles: [String; 2],
    contact: String,
}

impl Written {
    fn set(&mut self, name: &'static str, text: String) {
        self.cells.push((name, text));
    }

    fn case(&self) -> String {
        let [one, two] = &self.vehicles;
        format!("schema = 1\n[[vehicle]]\n{one}\n[[vehicle]]\n{two}\n[contact]\n{}\n", self.contact)
    }
}

const NAMES: [&str; 30] = [
    "vehicle.1.mass",
    "vehicle.1.yaw_inertia",
    "vehicle.1.radius_of_gyration",
    "vehicle.1.heading",
    "vehicle.1.speed",
    "vehicle.1.velocity.x",
    "vehicle.1.velocity.y",
    "vehicle.1.yaw_rate",
    "vehicle.1.impact_center.forward",
    "vehicle.1.impact_center.left",
    "vehicle.1.barrier",
    "vehicle.2.mass",
    "vehicle.2.yaw_inertia",
    "vehicle.2.radius_of_gyration",
    "vehicle.2.heading",
    "vehicle.2.speed",
    "vehicle.2.velocity.x",
    "vehicle.2.velocity.y",
    "vehicle.2.yaw_rate",
    "vehicle.2.impact_center.forward",
    "vehicle.2.impact_center.left",
    "vehicle.2.barrier",
    "contact.crush_plane",
    "contact.restitution",
    "contact.impulse_ratio",
    "contact.impulse_ratio.of_critical",
    "contact.friction",
    "contact.tangential_law",
    "contact.moment",
    "contact.moment.of_critical",
];

fn name(of: &str) -> &'static str {
    NAMES.into_iter().find(|name| *name == of).unwrap_or_else(|| panic!("{of}"))
}

/// Draws a row in every form that a case file has.
fn drawn(rng: &mut ChaCha8Rng) -> Written {
    let mut row = Written::default();
    let barrier = rng.random_ratio(1, 6);
    for side in [1, 2] {
        let mut keys = String::new();
        let mut key = |name_of: &str, text: String, keys: &mut String, as_key: &str| {
            row.set(name(&format!("vehicle.{side}.{name_of}")), text.clone());
            *keys += &format!("{as_key} = {text}\n");
        };
        if side == 2 && barrier {
            key("barrier", "true".to_owned(), &mut keys, "barrier");
            row.vehicles[1] = keys;
            continue;
        }
        let number = |x: f64| format!("{x:?}");
        key("mass", number(rng.random_range(900.0..2500.0)), &mut keys, "mass");
        match rng.random_bool(0.5) {
            true => key("yaw_inertia", number(rng.random_range(1200.0..4500.0)), &mut keys, "yaw_inertia"),
            false => key("radius_of_gyration", number(rng.random_range(1.0..1.6)), &mut keys, "radius_of_gyration"),
        }
        let heading = rng.random_range(-0.6..0.6) + if side == 2 { 3.0 } else { 0.0 };
        key("heading", number(heading), &mut keys, "heading");
        if rng.random_bool(0.5) {
            key("speed", number(rng.random_range(-3.0..30.0)), &mut keys, "speed");
        } else {
            let [x, y] = [rng.random_range(-20.0..20.0), rng.random_range(-8.0..8.0)];
            row.set(name(&format!("vehicle.{side}.velocity.x")), number(x));
            row.set(name(&format!("vehicle.{side}.velocity.y")), number(y));
            keys += &format!("velocity = [{x:?}, {y:?}]\n");
        }
        if rng.random_bool(0.7) {
            let mut key = |name_of: &str, text: String| {
                row.set(name(&format!("vehicle.{side}.{name_of}")), text.clone());
                keys += &format!("{name_of} = {text}\n");
            };
            key("yaw_rate", number(rng.random_range(-1.0..1.0)));
        }
        let [forward, left] = [rng.random_range(1.0..2.5), rng.random_range(-0.9..0.9)];
        row.set(name(&format!("vehicle.{side}.impact_center.forward")), number(forward));
        row.set(name(&format!("vehicle.{side}.impact_center.left")), number(left));
        keys += &format!("impact_center = [{forward:?}, {left:?}]\n");
        row.vehicles[side - 1] = keys;
    }
    let mut contact = |name_of: &str, text: String, as_text: String| {
        row.set(name(&format!("contact.{name_of}")), text);
        row.contact += &as_text;
    };
    let plain = |key: &str, x: f64| (format!("{x:?}"), format!("{key} = {x:?}\n"));
    let (text, line) = plain("crush_plane", rng.random_range(-0.5..0.5));
    contact("crush_plane", text, line);
    let (text, line) = plain("restitution", rng.random_range(0.0..0.4));
    contact("restitution", text, line);
    let x: f64 = rng.random_range(0.0..1.0);
    match rng.random_range(0..5) {
        0 => contact("impulse_ratio", "critical".to_owned(), "impulse_ratio = \"critical\"\n".to_owned()),
        1 => contact("impulse_ratio", format!("{:?}", 0.1 * x), format!("impulse_ratio = {:?}\n", 0.1 * x)),
        2 => contact("impulse_ratio.of_critical", format!("{x:?}"), format!("impulse_ratio = {{ of_critical = {x:?} }}\n")),
        3 => contact("friction", format!("{x:?}"), format!("friction = {x:?}\n")),
        _ => (),
    }
    if rng.random_ratio(1, 4) {
        contact("tangential_law", "kudlich-slibar".to_owned(), "tangential_law = \"kudlich-slibar\"\n".to_owned());
    }
    match rng.random_range(0..12) {
        0 => contact("moment", format!("{:?}", 50.0 * x), format!("moment = {:?}\n", 50.0 * x)),
        1 => contact("moment.of_critical", format!("{x:?}"), format!("moment = {{ of_critical = {x:?} }}\n")),
        _ => (),
    }
    row
}

/// Draws a car ahead of a barrier with the normal along x, so that K_nn = 1/m + l²/I and K_nt = −f l/I.
fn grazing(rng: &mut ChaCha8Rng) -> Written {
    let mut row = Written::default();
    let [m, inertia, f, l] = [1500.0, 2500.0, rng.random_range(1.0..2.5), rng.random_range(0.4..0.9)];
    let share = 10.0_f64.powf(rng.random_range(-8.0..-4.0));
    let wedged = (1.0 / m + l * l / inertia) / (f * l / inertia);
    let numbers = [
        ("vehicle.1.mass", m),
        ("vehicle.1.yaw_inertia", inertia),
        ("vehicle.1.heading", 0.0),
        ("vehicle.1.velocity.x", share * rng.random_range(1.0..20.0)),
        ("vehicle.1.velocity.y", rng.random_range(-20.0..20.0)),
        ("vehicle.1.impact_center.forward", f),
        ("vehicle.1.impact_center.left", l),
        ("contact.crush_plane", 0.0),
        ("contact.restitution", 0.1),
        ("contact.impulse_ratio", wedged * (1.0 - share)),
    ];
    numbers.iter().for_each(|(name, number)| row.set(name, format!("{number:?}")));
    row.set("vehicle.2.barrier", "true".to_owned());
    let [.., x, y, _, _, _, _, ratio] = numbers.map(|(_, number)| number);
    row.vehicles = [
        format!("mass = {m:?}\nyaw_inertia = {inertia:?}\nheading = 0.0\nvelocity = [{x:?}, {y:?}]\nimpact_center = [{f:?}, {l:?}]"),
        "barrier = true".to_owned(),
    ];
    row.contact = format!("crush_plane = 0.0\nrestitution = 0.1\nimpulse_ratio = {ratio:?}\n");
    row
}

fn parse(text: String) -> Result<Case, Issues> {
    Case::parse(Source::new("row.toml", text))
}

fn plan(names: &[&str], base: Option<&Case>, options: &Options) -> Result<Plan, Issues> {
    Plan::of(&names.iter().map(|name| Header::read(name)).collect::<Vec<_>>(), base, options)
}

fn cells<'a>(plan: &Plan, names: &[&str], rows: impl Iterator<Item = &'a Written> + Clone) -> Vec<Column<'static>> {
    let of = |column: &InputColumn| {
        let name = names[column.place];
        let text = |row: &Written| row.cells.iter().find(|(of, _)| *of == name).map_or("", |(_, text)| text).to_owned();
        Column::Cells(rows.clone().map(|row| column.of_text(&text(row))).collect())
    };
    plan.inputs().iter().map(of).collect()
}

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn every_row_is_the_case_file_that_it_stands_for() {
    let mut rng = ChaCha8Rng::seed_from_u64(14);
    // More than one stretch of rows, and a last one that is not whole.
    let rows: Vec<Written> = (0..5000).map(|_| drawn(&mut rng)).collect();
    let plan = plan(&NAMES, None, &Options::default()).expect("a plan");
    let answer = plan.solve(&Table { rows: rows.len(), columns: cells(&plan, &NAMES, rows.iter()), unreadable: Vec::new() });
    let mut refused = answer.refused.iter().peekable();
    let mut solved = 0;
    for (i, row) in rows.iter().enumerate() {
        let case = parse(row.case()).unwrap_or_else(|issues| panic!("{}: {issues}", row.case()));
        match case.setup.solve() {
            Ok(outputs) => {
                solved += 1;
                assert!(refused.peek().is_none_or(|refused| refused.row != i), "row {i}: {:?}\n{}", refused.peek(), row.case());
                for (k, output) in plan.outputs().iter().enumerate() {
                    let alone = outputs.get(*output).map(|value| value + 0.0).expect("an output of every case");
                    assert_eq!(answer.outputs[k][i].to_bits(), alone.to_bits(), "{output} of row {i}:\n{}", row.case());
                }
            }
            Err(refusals) => {
                let refused = refused.next().unwrap_or_else(|| panic!("row {i} is refused: {refusals}\n{}", row.case()));
                assert_eq!(
                    (refused.row, refused.codes.as_str(), refused.is_of_input),
                    (i, crate::wording::codes(&refusals).as_str(), false)
                );
                assert!(answer.outputs.iter().all(|column| column[i].is_nan()), "row {i}");
            }
        }
    }
    assert_eq!(refused.next(), None);
    assert!((2000..4900).contains(&solved), "{solved} of {} rows are solved", rows.len());
}

/// Warnings follow from bounds of a row that spare it a solution of its own: none may be lost by them, and none added.
#[test]
fn a_row_has_the_warnings_of_its_case_file() {
    let mut rng = ChaCha8Rng::seed_from_u64(27);
    let plan = plan(&NAMES, None, &Options::default()).expect("a plan");
    let mut counts = BTreeMap::new();
    for _ in 0..6000 {
        let mut row = drawn(&mut rng);
        // Radii of gyration and offsets of every size, at which pairs wedge, and restitutions up to 1, at which some gain energy.
        let replace = |row: &mut Written, name: &str, key: &str, number: f64| {
            let Some(cell) = row.cells.iter_mut().find(|(of, _)| *of == name) else { return };
            let side = if name.contains(".2.") { 1 } else { 0 };
            let keys = if name.starts_with("vehicle") { &mut row.vehicles[side] } else { &mut row.contact };
            *keys = keys.replace(&format!("{key} = {}\n", cell.1), &format!("{key} = {number:?}\n"));
            cell.1 = format!("{number:?}");
        };
        for side in 1..=2 {
            if rng.random_bool(0.4) {
                let radius = 10.0_f64.powf(rng.random_range(-3.0..0.3));
                replace(&mut row, &format!("vehicle.{side}.radius_of_gyration"), "radius_of_gyration", radius);
                replace(&mut row, &format!("vehicle.{side}.yaw_inertia"), "yaw_inertia", 1500.0 * radius * radius);
            }
        }
        if rng.random_bool(0.5) {
            replace(&mut row, "contact.restitution", "restitution", rng.random_range(0.0..1.0));
        }
        // A usual car that grazes a barrier, at an impulse ratio that nearly wedges it: P_n/K_nn grows without bound, and little energy with it.
        if rng.random_ratio(1, 5) {
            row = grazing(&mut rng);
        }
        let case = parse(row.case()).unwrap_or_else(|issues| panic!("{}: {issues}", row.case()));
        let rows = [row];
        let answer = plan.solve(&Table { rows: 1, columns: cells(&plan, &NAMES, rows.iter()), unreadable: Vec::new() });
        let of_row: BTreeSet<_> =
            answer.warnings.iter().map(|RowWarning { notice, .. }| (notice.code.to_owned(), notice.path.clone())).collect();
        match case.collision.solve() {
            Ok(impact) => {
                let all = case.warnings(&impact).into_iter().filter(|notice| notice.code != "tangential-work-positive");
                let alone: BTreeSet<_> = all.map(|notice| (notice.code.to_owned(), notice.path)).collect();
                let is_usual = !alone.iter().any(|(code, _)| code.starts_with("unusual"));
                alone.iter().for_each(|(code, _)| *counts.entry((code.clone(), is_usual)).or_insert(0) += 1);
                assert_eq!(of_row, alone, "{}", rows[0].case());
            }
            Err(_) => assert!(of_row.iter().all(|(code, _)| code.starts_with("unusual")), "{of_row:?}\n{}", rows[0].case()),
        }
    }
    for (code, is_usual) in
        [("restitution-can-gain-energy", true), ("nearly-wedged", true), ("nearly-wedged", false), ("few-digits", false)]
    {
        assert!(counts.get(&(code.to_owned(), is_usual)).is_some_and(|count| *count >= 20), "{code}: {counts:?}");
    }
}

#[test]
fn a_row_with_less_energy_than_its_crush_is_warned_of() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let speeds = [15.0, 1.0, 0.0, 2.0];
    for of in [vec![], named(&["T_L"])] {
        let options = Options { of, ..Options::default() };
        let found = |names: &[&str], columns: Vec<Column<'static>>| -> Vec<_> {
            let answer = plan(names, Some(&case), &options).expect("a plan").solve(&Table { rows: 4, columns, unreadable: Vec::new() });
            answer.warnings.into_iter().map(|RowWarning { first, rows, notice }| (notice.code, notice.path, first, rows)).collect()
        };
        let column = |numbers: [f64; 4]| Column::Cells(numbers.map(Cell::Number).to_vec());
        let with_crush = found(&["vehicle.1.speed", "vehicle.1.crush.width"], vec![column(speeds), column([1.5; 4])]);
        assert_eq!(with_crush, [("crush-beyond-energy", "vehicle".to_owned(), 1, 2)], "the third row does not collide");
        assert_eq!(found(&["vehicle.1.speed"], vec![column(speeds)]), [], "the crush of the case is not that of other speeds");
    }
}

#[test]
fn empty_cells_are_those_of_the_case() {
    let mut rng = ChaCha8Rng::seed_from_u64(15);
    for _ in 0..200 {
        let (row, base) = (drawn(&mut rng), drawn(&mut rng));
        let Ok(case) = parse(base.case()) else { panic!("{}", base.case()) };
        let plan = match plan(&NAMES, Some(&case), &Options { of: named(&["T_L", "V1x", "dV2"]), ..Options::default() }) {
            Ok(plan) => plan,
            Err(issues) => panic!("{issues}"),
        };
        // The first row is empty; the second gives everything, and so nothing of the case is left but a ratio, a law and a moment.
        let rows = [Written::default(), row.clone()];
        let answer = plan.solve(&Table { rows: 2, columns: cells(&plan, &NAMES, rows.iter()), unreadable: Vec::new() });
        let found = |i: usize| answer.refused.iter().find(|refused| refused.row == i);
        match (case.setup.solve(), found(0)) {
            (Ok(outputs), None) => {
                let alone = |k: usize| outputs.get(plan.outputs()[k]).map(|value| value + 0.0);
                (0..3).for_each(|k| assert_eq!(Some(answer.outputs[k][0]), alone(k), "{}", base.case()));
            }
            (Err(refusals), Some(refused)) => assert_eq!(refused.codes, crate::wording::codes(&refusals)),
            (alone, refused) => panic!("{alone:?} {refused:?}\n{}", base.case()),
        }
        let barriers = |row: &Written| row.vehicles[1].starts_with("barrier");
        if barriers(&base) && !barriers(&row) {
            // Nothing says that this row is not of the barrier.
            assert_eq!(found(1).map(|refused| refused.codes.as_str()), Some("conflict"));
        }
    }
}

#[test]
fn derivatives_are_those_of_the_verb_gradient() {
    let mut rng = ChaCha8Rng::seed_from_u64(16);
    let of = ["W_n", "T_L", "mu0", "dV1", "V2y", "Omega1", "vehicle.1.pdof"];
    let wrt = [
        "m1",
        "I1",
        "k1",
        "theta1",
        "v1",
        "vehicle.1.velocity.x",
        "vehicle.1.velocity.y",
        "omega1",
        "vehicle.1.impact_center.left",
        "m2",
        "k2",
        "theta2",
        "v2",
        "Gamma",
        "e",
        "mu",
        "contact.friction",
        "contact.impulse_ratio.of_critical",
        "contact.moment",
        "contact.moment.of_critical",
    ];
    let options = Options { of: named(&of), wrt: named(&wrt), check: true, fast: false };
    let plan = plan(&NAMES, None, &options).expect("a plan");
    let rows: Vec<Written> = (0..400).map(|_| drawn(&mut rng)).collect();
    let answer = plan.solve(&Table { rows: rows.len(), columns: cells(&plan, &NAMES, rows.iter()), unreadable: Vec::new() });
    let (mut compared, mut absent) = (0, 0);
    for (i, row) in rows.iter().enumerate() {
        let case = parse(row.case()).expect("a case");
        if answer.refused.iter().any(|refused| refused.row == i) {
            assert!(answer.derivatives.iter().all(|column| column[i].is_nan()));
            continue;
        }
        assert_eq!(answer.check.as_ref().map(|check| check[i].clone()), Some(None), "row {i}");
        for (k, by) in plan.wrt().iter().enumerate() {
            let has = case.inputs.value(*by).is_ok() || *by == Parameter::Input(Input::ImpulseRatio);
            let gradient = has.then(|| {
                let selected = |names: &[String]| Selection::Named(names.to_vec());
                let options = gradient::Options { of: selected(&named(&of)), wrt: selected(&[by.to_string()]), second: false };
                gradient::gradient(&case, &options, &Uncontrolled).expect("a gradient")
            });
            for (j, output) in plan.outputs().iter().enumerate() {
                let found = answer.derivatives[j * wrt.len() + k][i];
                let Some(expected) =
                    gradient.as_ref().and_then(|gradient| gradient.of.get(&output.to_string())?.d.get(&by.to_string()).copied())
                else {
                    absent += 1;
                    assert!(found.is_nan(), "d {output} / d {by} in row {i}: {found}\n{}", row.case());
                    continue;
                };
                compared += 1;
                let scale = gradient.as_ref().map_or(1.0, |gradient| gradient.scale(*output)).max(expected.abs());
                assert!((found - expected).abs() <= 1e-11 * scale, "d {output} / d {by} in row {i}: {found} {expected}\n{}", row.case());
            }
        }
    }
    assert!(compared > 15_000 && absent > 2000, "{compared} derivatives compared, {absent} absent");
}

#[test]
fn a_derivative_beyond_every_float_leaves_the_others() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let options = Options {
        of: named(&["T_L", "contact.separation.normal"]),
        wrt: named(&["vehicle.1.impact_center.left", "v1"]),
        ..Options::default()
    };
    let center = ["vehicle.1.impact_center.forward", "vehicle.1.impact_center.left"];
    let plan = plan(&["vehicle.1.yaw_inertia", center[0], center[1], "vehicle.1.speed"], Some(&case), &options).expect("a plan");
    // A speed at which the energy is just within reach of a float, and its derivative by a millimetre of the offset is not.
    let column = |numbers: [f64; 2]| Column::Cells(numbers.map(Cell::Number).to_vec());
    let columns = vec![column([1.5e-3; 2]), column([1e-3; 2]), column([1e-3; 2]), column([3.6e151, 15.0])];
    let answer = plan.solve(&Table { rows: 2, columns, unreadable: Vec::new() });
    let codes: Vec<_> = answer.refused.iter().map(|refused| (refused.row, refused.codes.as_str())).collect();
    assert_eq!(codes, [(0, "out-of-range")]);
    assert!(answer.outputs.iter().chain(&answer.derivatives).all(|column| column[0].is_nan() && column[1].is_finite()));
}

const CRUSHED: &str = r#"
schema = 1
[[vehicle]]
mass = "1400 kg"
yaw_inertia = "2400 kg m^2"
heading = 0
speed = "15 m/s"
impact_center = ["1.9 m", "0.2 m"]
[vehicle.crush]
width = "1.5 m"
depths = ["0.1 m", "0.3 m", "0.2 m"]
stiffness = { d0 = "90 N^0.5", d1 = "1000 N^0.5/m" }
[[vehicle]]
barrier = true
[contact]
crush_plane = 0
restitution = 0.1
"#;

#[test]
fn a_crush_is_that_of_the_case_with_the_numbers_of_the_row() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let names = ["vehicle.1.crush.depths.2", "vehicle.1.mass", "vehicle.1.crush.width"];
    let options = Options { wrt: named(&["vehicle.1.crush.depths.2", "m1", "v1"]), ..Options::default() };
    let plan = plan(&names, Some(&case), &options).expect("a plan");
    assert!(plan.outputs().contains(&CaseOutput::CrushEnergy(Side::One)), "every output of `solve`");
    let columns = vec![
        Column::Cells(vec![Cell::Number(0.5), Cell::Empty, Cell::Number(-0.1), Cell::Unreadable("deep".into()), Cell::Empty]),
        Column::Cells(vec![Cell::Empty, Cell::Number(1200.0), Cell::Empty, Cell::Empty, Cell::Empty]),
        Column::Cells(vec![Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty, Cell::Number(0.0)]),
    ];
    let answer = plan.solve(&Table { rows: 5, columns, unreadable: Vec::new() });
    let codes: Vec<_> = answer.refused.iter().map(|refused| (refused.row, refused.codes.as_str(), refused.is_of_input)).collect();
    assert_eq!(codes, [(2, "out-of-range", true), (3, "unreadable", true), (4, "not-positive", true)]);
    assert_eq!(
        answer.refused[1].reason.to_string(),
        "vehicle.1.crush.depths.2 is `deep`; it must be a number, without a unit and with a point"
    );
    let depth = Parameter::named("vehicle.1.crush.depths.2").expect("a parameter");
    for (row, changed) in [(0, (depth, 0.5)), (1, (Parameter::Input(Input::Mass(Side::One)), 1200.0))] {
        let alone = case.with(&[changed]);
        let outputs = alone.setup.solve().expect("it is solved");
        let gradient = gradient::gradient(&alone, &gradient::Options::default(), &Uncontrolled).expect("a gradient");
        for (j, output) in plan.outputs().iter().enumerate() {
            let expected = outputs.get(*output).map(|value| value + 0.0).expect("an output");
            assert_eq!(answer.outputs[j][row].to_bits(), expected.to_bits(), "{output}");
            for (k, by) in plan.wrt().iter().enumerate() {
                let found = answer.derivatives[j * 3 + k][row];
                let expected = *gradient.of.get(&output.to_string()).and_then(|of| of.d.get(&by.to_string())).expect("a derivative");
                let scale = gradient.scale(*output).max(expected.abs());
                assert!((found - expected).abs() <= 1e-11 * scale, "d {output} / d {by}: {found} {expected}");
            }
        }
    }
}

#[test]
fn what_is_wrong_with_a_row_it_says() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    let good = std::iter::repeat_with(|| drawn(&mut rng))
        .find(|row| {
            row.cells.iter().any(|(name, _)| *name == "vehicle.2.speed") && row.cells.iter().any(|(name, _)| *name == "contact.friction")
        })
        .expect("there is one");
    let with = |name_of: &str, text: &str| {
        let mut row = good.clone();
        row.cells.retain(|(name, _)| *name != name_of);
        row.set(name(name_of), text.to_owned());
        row
    };
    let rows = [
        with("vehicle.1.mass", "abc"),
        with("vehicle.1.mass", ""),
        with("vehicle.2.speed", ""),
        with("vehicle.2.velocity.y", "1"),
        with("contact.impulse_ratio", "critical"),
        with("vehicle.2.barrier", "true"),
        with("vehicle.2.barrier", "perhaps"),
        with("contact.tangential_law", "none"),
        with("contact.restitution", "critical"),
        with("vehicle.1.mass", "-5"),
        with("vehicle.1.mass", "nan"),
        with("vehicle.1.mass", "1e999"),
        with("contact.restitution", "1.5"),
        good.clone(),
    ];
    let plan = plan(&NAMES, None, &Options::default()).expect("a plan");
    let answer = plan.solve(&Table {
        rows: rows.len(),
        columns: cells(&plan, &NAMES, rows.iter()),
        unreadable: vec![(13, NotARow::Ragged { cells: 4, columns: 3 })],
    });
    let said: Vec<(&str, String)> =
        answer.refused.iter().map(|refused| (refused.codes.as_str(), crate::units::Units::Si.sentence(&refused.reason))).collect();
    let expected = [
        ("unreadable", "vehicle.1.mass is `abc`; it must be a number"),
        ("missing-key", "vehicle.1.mass is missing"),
        ("missing-key", "vehicle.2.speed is missing"),
        ("conflict", "vehicle.2.speed and vehicle.2.velocity.y exclude each other"),
        ("conflict", "contact.impulse_ratio and contact.friction exclude each other"),
        ("conflict", "vehicle.2.barrier and vehicle.2.mass exclude each other"),
        ("unreadable", "vehicle.2.barrier is `perhaps`; it must be `true` or `false`"),
        ("unreadable", "contact.tangential_law is `none`; it must be `brach`"),
        ("unreadable", "contact.restitution is `critical`; it must be a number"),
        ("not-positive", "vehicle.1.mass is -5 kg; it must be above zero"),
        ("not-finite", "vehicle.1.mass is not finite: NaN"),
        ("not-finite", "vehicle.1.mass is not finite: inf"),
        ("out-of-range", "contact.restitution is 1.5; it must be from 0 to 1"),
        ("unreadable", "the row has 4 cells, and the table has 3 columns; a decimal comma?"),
    ];
    for (i, ((codes, reason), (code, sentence))) in said.iter().zip(expected).enumerate() {
        assert!(codes.split(';').any(|found| found == code) && reason.contains(sentence), "row {i}: {codes}: {reason}");
        assert!(answer.refused[i].is_of_input && answer.refused[i].row == i);
    }
    assert_eq!(said.len(), expected.len());
}

#[test]
fn a_number_that_a_case_file_refuses_is_refused() {
    let line = |name: &str, number: f64| match name {
        "vehicle.1.radius_of_gyration" => CRUSHED.replace("yaw_inertia = \"2400 kg m^2\"", &format!("radius_of_gyration = {number:?}")),
        "vehicle.1.crush.width" => CRUSHED.replace("\"1.5 m\"", &format!("{number:?}")),
        "vehicle.1.crush.depths.1" => CRUSHED.replace("\"0.1 m\"", &format!("{number:?}")),
        "vehicle.1.crush.d0" => CRUSHED.replace("\"90 N^0.5\"", &format!("{number:?}")),
        "vehicle.1.crush.d1" => CRUSHED.replace("\"1000 N^0.5/m\"", &format!("{number:?}")),
        "contact.impulse_ratio.of_critical" => format!("{CRUSHED}impulse_ratio = {{ of_critical = {number:?} }}\n"),
        "contact.moment.of_critical" => format!("{CRUSHED}moment = {{ of_critical = {number:?} }}\n"),
        "contact.restitution" => CRUSHED.replace("restitution = 0.1", &format!("restitution = {number:?}")),
        _ => format!("{CRUSHED}{} = {number:?}\n", name.trim_start_matches("contact.")),
    };
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let names = [
        "vehicle.1.radius_of_gyration",
        "vehicle.1.crush.width",
        "vehicle.1.crush.depths.1",
        "vehicle.1.crush.d0",
        "vehicle.1.crush.d1",
        "contact.impulse_ratio.of_critical",
        "contact.moment.of_critical",
        "contact.restitution",
        "contact.friction",
        "contact.moment",
    ];
    let mut refused = 0;
    for name in names {
        for number in [-1.3, -0.0, 0.0, 0.4, 1.0, 1.7] {
            let plan = plan(&[name], Some(&case), &Options::default()).expect("a plan");
            let answer = plan.solve(&Table { rows: 1, columns: vec![Column::Cells(vec![Cell::Number(number)])], unreadable: Vec::new() });
            let alone = parse(line(name, number)).and_then(|case| match case.setup.crush[0].as_ref().and_then(crate::case::Crush::unfit) {
                Some(unfit) => Err(Issues::defect(unfit)),
                None => case.impact(),
            });
            refused += usize::from(alone.is_err());
            assert_eq!(answer.refused.is_empty(), alone.is_ok(), "{name} = {number}: {:?} {alone:?}", answer.refused);
        }
    }
    assert!((10..50).contains(&refused), "{refused}");
}

#[test]
fn a_number_is_as_large_as_in_a_case_file_with_a_unit_or_without_one() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let columns = [
        ("vehicle.1.mass", "mass = \"1400 kg\"", "mass", "kg", "g"),
        ("vehicle.1.yaw_inertia", "yaw_inertia = \"2400 kg m^2\"", "yaw_inertia", "kg m^2", "lb ft^2"),
        ("vehicle.1.heading", "heading = 0", "heading", "rad", "deg"),
        ("vehicle.1.speed", "speed = \"15 m/s\"", "speed", "m/s", "km/h"),
        ("contact.crush_plane", "crush_plane = 0", "crush_plane", "rad", "deg"),
    ];
    let (mut accepted, mut implausible) = (0, 0);
    for (name, given, key, si, other) in columns {
        for unit in [None, Some(si), Some(other)] {
            let header = unit.map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"));
            let plan = plan(&[&header], Some(&case), &Options::default()).expect("a plan");
            for number in [1e-13, 2e-7, 5e-4, 0.09, 0.2, 6.2, 6.3, 29.0, 149.0, 151.0, 1e4, 2e4, 1e5, 1.1e6, 9e8, 1.1e9, 1e14, 1.1e15] {
                let written = unit.map_or_else(|| format!("{number:?}"), |unit| format!("\"{number:?} {unit}\""));
                let is_read = parse(CRUSHED.replace(given, &format!("{key} = {written}"))).is_ok();
                let cells = vec![Column::Cells(vec![plan.inputs()[0].of_number(number)])];
                let answer = plan.solve(&Table { rows: 1, columns: cells, unreadable: Vec::new() });
                let codes = answer.refused.first().map(|refused| refused.codes.clone());
                assert_eq!(codes.as_deref() == Some("out-of-range"), !is_read, "{header} {number}: {:?}", answer.refused);
                accepted += usize::from(is_read);
                if let Some(refused) = answer.refused.first().filter(|_| !is_read) {
                    let sentence = crate::Units::Si.sentence(&refused.reason);
                    let remedy = format!("write the header `{name} [");
                    let has_word = sentence.contains("too large for") || sentence.contains("too small for");
                    assert!(
                        sentence.starts_with(&format!("{name} is ")) && if unit.is_some() { has_word } else { sentence.contains(&remedy) },
                        "{sentence}"
                    );
                    implausible += 1;
                }
            }
        }
    }
    assert!(accepted > 100 && implausible > 60, "{accepted} {implausible}");
    // An infinite number stays what it is in another unit.
    let plan = plan(&["vehicle.1.speed [mph]"], Some(&case), &Options::default()).expect("a plan");
    let cells = vec![Column::Cells(["inf", "-1e400"].map(|text| plan.inputs()[0].of_text(text)).to_vec())];
    let answer = plan.solve(&Table { rows: 2, columns: cells, unreadable: Vec::new() });
    let said = answer.refused.iter().map(|refused| crate::Units::Si.sentence(&refused.reason)).collect::<Vec<_>>();
    assert_eq!(said, ["vehicle.1.speed is not finite: inf", "vehicle.1.speed is not finite: -inf"]);
}

#[test]
fn uncertain_numbers_that_no_column_gives_are_named_once() {
    let uncertain =
        CRUSHED.replace("\"15 m/s\"", "\"15 m/s ± 1 m/s\"").replace("restitution = 0.1", "restitution = { min = 0.1, max = 0.2 }");
    let case = parse(uncertain).expect("a case");
    let said = |column: &str| {
        let plan = plan(&[column], Some(&case), &Options::default()).expect("a plan");
        let (assumed, others): (Vec<_>, Vec<_>) = plan.notices(Some(&case)).into_iter().partition(|notice| notice.code == "unit-assumed");
        // Of the numbers of the case that the column does not replace.
        let heading = assumed.iter().any(|notice| notice.path == "vehicle.1.heading");
        assert_eq!((heading, assumed.len()), (column != "vehicle.1.heading [deg]", if heading { 2 } else { 1 }), "{assumed:?}");
        others.iter().map(|notice| crate::Units::Si.sentence(&notice.message)).collect::<Vec<_>>()
    };
    let both = "uncertain inputs are used at their nominal values: vehicle.1.speed, contact.restitution";
    assert_eq!([said("vehicle.1.mass [kg]"), said("vehicle.1.heading [deg]")], [[both]; 2]);
    let one = ["contact.restitution is uncertain, and used at its nominal value"];
    assert_eq!([said("vehicle.1.speed"), said("vehicle.1.velocity.y")], [one, one]);
    let columns = ["vehicle.1.speed [m/s]", "contact.restitution", "vehicle.1.heading [deg]", "contact.crush_plane [deg]"];
    let plan = plan(&columns, Some(&case), &Options::default()).expect("a plan");
    assert!(plan.notices(Some(&case)).is_empty() && plan.notices(None).is_empty());
}

#[test]
fn a_column_that_may_be_meant_as_an_input_is_named() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let columns = ["vehicle.1.mass", "e", "Speed [mph]", "velocity.x", "site", "x", "left", "refused", "weight", "rest.friction"];
    let plan = plan(&columns, Some(&case), &Options::default()).expect("a plan");
    let notices: Vec<_> = plan.notices(Some(&case)).into_iter().filter(|notice| notice.code != "unit-assumed").collect();
    let said: Vec<String> =
        notices.iter().map(|notice| format!("{}: {}", notice.path, crate::Units::Si.sentence(&notice.message))).collect();
    assert!(notices.iter().all(|notice| notice.severity == crate::notice::Severity::Warning));
    assert_eq!(
        said,
        [
            "e: the column `e` passes through unread; as an input it is named contact.restitution",
            "Speed: the column `Speed` passes through unread; as an input it is named vehicle.1.speed [mph] or vehicle.2.speed [mph]",
            "velocity.x: the column `velocity.x` passes through unread; as an input it is named vehicle.1.velocity.x or vehicle.2.velocity.x",
            "weight: the column `weight` passes through unread; as an input it is named vehicle.1.mass [kg] or [lb] or vehicle.2.mass [kg] or [lb]",
            "rest.friction: the column `rest.friction` passes through unread; a table has inputs of the collision alone, which begin with `vehicle.` or `contact.`",
        ]
    );
    let meant = |name: &str| super::column::meant_by(&Header::read(name)).join(" ");
    for (name, input) in [
        ("vx2", "vehicle.2.velocity.x"),
        ("v1x [km/h]", "vehicle.1.velocity.x [km/h]"),
        ("b2.before.vx", "vehicle.2.velocity.x"),
        ("2.speed", "vehicle.2.speed"),
        ("Speed 1 (mph)", "vehicle.1.speed [mph]"),
        ("speed_1_kph", "vehicle.1.speed [kph]"),
        ("V2_mph", "vehicle.2.speed [mph]"),
        ("mass_lb_2", "vehicle.2.mass [lb]"),
        ("W2 [lb]", "vehicle.2.mass [lb]"),
        ("weight1 [lbf]", "vehicle.1.mass [kg] or [lb]"),
        ("vehicle(1).speed", "vehicle.1.speed"),
        ("Unit 1 speed (mph)", "vehicle.1.speed [mph]"),
        ("w2 [rad/s]", "vehicle.2.yaw_rate [rad/s]"),
        ("w2", "vehicle.2.mass [kg] or [lb] vehicle.2.yaw_rate"),
        ("yaw1", "vehicle.1.heading vehicle.1.yaw_rate"),
        ("car 1 yaw inertia", "vehicle.1.yaw_inertia"),
        ("I_1", "vehicle.1.yaw_inertia"),
        ("ω₂", "vehicle.2.yaw_rate"),
        ("Γ [deg]", "contact.crush_plane [deg]"),
        ("normal angle", "contact.crush_plane"),
        ("COR", "contact.restitution"),
        ("fric", "contact.friction"),
        ("mu_friction", "contact.friction"),
        ("of_critical", "contact.impulse_ratio.of_critical"),
        ("law", "contact.tangential_law"),
        ("barrier2", "vehicle.2.barrier"),
    ] {
        assert_eq!(meant(name), input, "{name}");
    }
    for own in [
        "",
        "x",
        "left",
        "2",
        "v",
        "car",
        "m",
        "w",
        "weight of 3",
        "site 1",
        "speed 1 2",
        "restitution 1",
        "mass after 1",
        "dV1",
        "é1",
        "1e5",
    ] {
        assert_eq!(meant(own), "", "{own}");
    }
    let pounds =
        self::plan(&["vehicle.1.yaw_inertia [lb ft s^2]", "vehicle.1.mass [lb]"], Some(&case), &Options::default()).expect("a plan");
    assert_eq!(
        pounds.notices(None).iter().map(|notice| (notice.code, notice.path.as_str())).collect::<Vec<_>>(),
        [("pound-force-assumed", "vehicle.1.yaw_inertia")]
    );
    for (name, remedy) in [
        ("contact.law", "did you mean `contact.tangential_law`?"),
        ("vehicle.1.name", "rename the column, so that it passes through"),
        ("vehicle.1.sped", "did you mean `vehicle.1.speed`?"),
    ] {
        let Err(refused) = self::plan(&[name, "vehicle.1.mass"], Some(&case), &Options::default()) else { panic!("{name}") };
        assert!(refused.to_string().contains(remedy), "{refused}");
    }
    let refused = self::plan(&["vehicle.1.weight [lbf]"], Some(&case), &Options::default());
    let Err(refused) = refused else { panic!("a weight") };
    assert!(refused.to_string().contains("give the mass, as `vehicle.1.mass [kg]`"), "{refused}");
}

#[test]
fn what_is_wrong_with_the_columns_is_said_at_once() {
    let wrong = |names: &[&str], base: Option<&Case>, options: &Options| -> Vec<(String, &'static str)> {
        match plan(names, base, options) {
            Ok(_) => Vec::new(),
            Err(issues) => issues.list().iter().map(|issue| (issue.path.clone(), issue.code)).collect(),
        }
    };
    let at = |path: &str, code: &'static str| (path.to_owned(), code);
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let all = Options::default();
    let names =
        ["vehicle.1.sped [mph]", "vehicle.1.mass [m]", "vehicle.1.mass", "vehicle.3.mass", "contact.tangential_law [m]", "site", "m1"];
    let found = wrong(&names, Some(&case), &all);
    for expected in [
        at("vehicle.1.sped", "unknown-column"),
        at("vehicle.1.mass", "invalid-unit"),
        at("vehicle.3.mass", "unknown-column"),
        at("contact.tangential_law", "invalid-unit"),
    ] {
        assert!(found.contains(&expected), "{expected:?} in {found:?}");
    }
    for (names, said) in [
        (&["contact.tangential_law [m]"][..], "contact.tangential_law: this column has words, and no unit; found `m`"),
        (&["vehicle.1.mass", "vehicle.1.mass [lb]"], "vehicle.1.mass: two columns have this name; keep one"),
        (
            &["vehicle.2.mass"],
            "vehicle.2.barrier: the case has a fixed barrier here, and the table has columns of a vehicle (drop them, or say which rows have a barrier in a column of `true` \
             and `false` named as this)",
        ),
        (
            &["contact.restitution", "energy.loss"],
            "energy.loss: the table has a column of this name already (drop or rename it, or name the outputs that are needed with --of)",
        ),
        (&["contact.restitution", "refusal"], "refusal: the table has a column of this name already (drop or rename it)"),
        (&["\u{200b}vehicle.1.speed"], "(it has characters that cannot be seen; write `vehicle.1.speed`)"),
        (&["vehicle.1.crush.depths.9"], "vehicle.1.crush.depths.9: the crush has 3 depths"),
    ] {
        let found = plan(names, Some(&case), &all).expect_err("refused").to_string();
        assert!(found.contains(said), "{found}");
    }
    let found = plan(&["vehicle.1.mass"], None, &all).expect_err("refused").to_string();
    for (path, remedy) in [
        ("vehicle.2", "add its columns, or give a case with --case; a fixed barrier is in a case, or a column of `true`"),
        ("vehicle.1.heading", "add the column, or give a case with --case"),
        ("vehicle.1.yaw_inertia", "add this column or `radius_of_gyration`, or give a case with --case"),
        ("vehicle.1.speed", "add this column or `velocity.x` and `velocity.y`, or give a case with --case"),
    ] {
        assert!(found.contains(&format!("{path}: neither a column nor a case gives it ({remedy})")), "{path}: {found}");
    }
    assert_eq!(wrong(&["vehicle.1.mass", "vehicle.1.mass [lb]"], Some(&case), &all), [at("vehicle.1.mass", "repeated-column")]);
    assert_eq!(wrong(&["vehicle.2.mass"], Some(&case), &all), [at("vehicle.2.barrier", "conflict")]);
    assert_eq!(wrong(&["vehicle.1.crush.depths.9"], Some(&case), &all), [at("vehicle.1.crush.depths.9", "not-in-case")]);
    assert_eq!(
        wrong(&["contact.restitution", "energy.loss", "refusal", "result.energy.loss"], Some(&case), &all),
        [at("energy.loss", "repeated-column"), at("refusal", "repeated-column"),]
    );
    assert_eq!(wrong(&["contact.restitution", "energy.loss"], Some(&case), &Options { of: named(&["W_n"]), ..all.clone() }), []);
    // Symbols and other words pass through; where nothing else stands, every row would be the case.
    assert_eq!(wrong(&["e", "speed"], Some(&case), &all), [at("", "no-input-column")]);
    assert_eq!(wrong(&["e", "speed", "contact.restitution"], Some(&case), &all), []);
    assert_eq!(wrong(&[], Some(&case), &all), [], "no columns are the case itself");
    for name in ["Vehicle.1.Speed", "CONTACT.restitution", "\u{200b}vehicle.1.speed", "vehicle.1.sp\u{ad}eed"] {
        assert_eq!(wrong(&[name, "contact.crush_plane"], Some(&case), &all), [at(name, "unknown-column")]);
    }
    let options = Options { of: named(&["T_X", "m1"]), wrt: named(&["T_L", "contact.friction"]), ..Options::default() };
    assert_eq!(
        wrong(&["vehicle.1.mass"], Some(&case), &options),
        [at("--of T_X", "call"), at("--of m1", "call"), at("--wrt T_L", "call"), at("--wrt contact.friction", "call"),]
    );
    let missing: Vec<String> = wrong(&["vehicle.1.mass"], None, &all).into_iter().map(|(path, _)| path).collect();
    let of_vehicle =
        ["yaw_inertia", "heading", "speed", "impact_center.forward", "impact_center.left"].map(|key| format!("vehicle.1.{key}"));
    let others = ["vehicle.2", "contact.crush_plane", "contact.restitution"].map(str::to_owned);
    assert_eq!(missing, of_vehicle.into_iter().chain(others).collect::<Vec<_>>());
}

#[test]
fn a_number_has_the_unit_of_its_column() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let plan = plan(&["vehicle.1.speed [mph]"], Some(&case), &Options { of: named(&["T_L"]), ..Options::default() }).expect("a plan");
    let column = &plan.inputs()[0];
    let Cell::Number(speed) = column.of_text(" 40 ") else { panic!("a number") };
    let read = crate::quantity::parse("40 mph", Parameter::Speed(Side::One).kind()).expect("a speed").si;
    assert_eq!(speed.to_bits(), read.to_bits());
    assert_eq!(column.of_number(40.0), Cell::Number(read));
    assert!(matches!(column.of_numbers(&[40.0]), Column::Numbers(speeds) if speeds[0] == read));
    assert_eq!((column.of_truth(true), column.of_text("40 mph")), (Cell::Unreadable("true".into()), Cell::Unreadable("40 mph".into())));
    assert_eq!(plan.names(), ["energy.loss", "refusal"]);
}

/// Spreadsheets write truths in capitals.
#[test]
fn truths_may_be_in_capitals() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let plan = plan(&["vehicle.2.barrier"], Some(&case), &Options::default()).expect("a plan");
    let read = ["true", "TRUE", "false", "False", "yes"].map(|text| plan.inputs()[0].of_text(text));
    let [one, zero] = [1.0, 0.0].map(Cell::Number);
    assert_eq!(read, [one.clone(), one, zero.clone(), zero, Cell::Unreadable("yes".into())]);
}

#[test]
fn unknowns_of_a_case_are_supplied_by_columns() {
    let text = CRUSHED.replace("speed = \"15 m/s\"\n", "")
        + "[unknown]\n\"vehicle.1.speed\" = { start = 12, min = 5, max = 30 }\n[evidence]\n\"energy.loss\" = \"100 kJ ± 1 kJ\"\n";
    let case = parse(text).unwrap_or_else(|issues| panic!("{issues}"));
    let of_loss = Options { of: named(&["T_L"]), ..Options::default() };
    let missing = plan(&["vehicle.1.mass"], Some(&case), &of_loss).expect_err("nothing gives the speed");
    assert_eq!(missing.list()[0].path, "vehicle.1.speed");
    let plan = plan(&["vehicle.1.speed"], Some(&case), &of_loss).expect("a plan");
    let columns = vec![Column::Cells(vec![Cell::Number(15.0), Cell::Empty])];
    let answer = plan.solve(&Table { rows: 2, columns, unreadable: Vec::new() });
    assert!(answer.outputs[0][0] > 0.0);
    assert_eq!(answer.refused.iter().map(|refused| refused.codes.as_str()).collect::<Vec<_>>(), ["missing-key"]);
}

#[test]
fn a_fast_plan_solves_fast() {
    let case = parse(CRUSHED.to_owned()).expect("a case");
    let speeds: Vec<f64> = (0..2000).map(|i| 10.0 + 0.01 * f64::from(i)).collect();
    let losses = |fast: bool| {
        let options = Options { of: named(&["T_L"]), fast, ..Options::default() };
        let plan = plan(&["vehicle.1.speed"], Some(&case), &options).expect("a plan");
        plan.solve(&Table { rows: speeds.len(), columns: vec![plan.inputs()[0].of_numbers(&speeds)], unreadable: Vec::new() })
            .outputs
            .remove(0)
    };
    let (exact, fast) = (losses(false), losses(true));
    assert!(exact.iter().zip(&fast).all(|(exact, fast)| (fast / exact - 1.0).abs() < 1e-13));
    let is_fused = planar_impact::batch::Instructions::best() != planar_impact::batch::Instructions::Compiled;
    assert_eq!(exact != fast, is_fused || cfg!(target_arch = "aarch64"));
}
