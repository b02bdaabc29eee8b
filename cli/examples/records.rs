//! Writes many collision records, to measure the speed and memory use of `planar-impact check`:
//!
//! ```sh
//! cargo run --release -p planar-impact-cli --example records -- 1000000 jsonl > /tmp/records.jsonl
//! /usr/bin/time -v target/release/planar-impact check /tmp/records.jsonl
//! ```
//!
//! The second argument is jsonl, json or csv; a third, `printed`, gives each number a resolution.
// Examples and comparisons compute as their readers do.
#![allow(clippy::disallowed_methods)]

use std::env;
use std::io::{self, BufWriter, Write};

use planar_impact::check::{Key, Record};
use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, ImpulseRatio, Law, Moment, Motion, Party, Vehicle, Xy};

/// A generator of pseudo-random numbers, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        // The generator of Knuth's MMIX.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn vehicle(&mut self) -> Vehicle {
        let mass = self.between(900.0, 2500.0);
        Vehicle {
            mass,
            yaw_inertia: mass * self.between(1.2, 1.7).powi(2),
            heading: Heading::from_angle(self.between(-3.0, 3.0)),
            impact_center: ForwardLeft { forward: self.between(-2.2, 2.2), left: self.between(-0.8, 0.8) },
            motion: Motion {
                velocity: Xy { x: self.between(-20.0, 20.0), y: self.between(-20.0, 20.0) },
                yaw_rate: self.between(-1.0, 1.0),
            },
        }
    }

    fn record(&mut self, number: u64) -> Record {
        loop {
            let collision = Collision {
                one: Party::Vehicle(self.vehicle()),
                two: Party::Vehicle(self.vehicle()),
                crush_plane: CrushPlane::from_angle(self.between(-3.0, 3.0)),
                restitution: self.between(0.0, 0.3),
                impulse_ratio: ImpulseRatio::LimitedByFriction(0.6),
                law: Law::Brach,
                moment: Moment::None,
            };
            if let Ok(impact) = collision.solve() {
                let id = format!("case-{number}");
                return Record { id, ..Record::of(&collision, &impact) };
            }
        }
    }
}

fn json(record: &Record, printed: bool) -> String {
    let number = |key: Key| record.get(key).map_or("null".to_owned(), |value| value.to_string());
    let pair = |x, y| format!("[{}, {}]", number(x), number(y));
    let body = |side| {
        format!(
            r#"{{"mass": {}, "yaw_inertia": {}, "cg": {}, "before": {{"v": {}, "yaw_rate": {}}}, "after": {{"v": {}, "yaw_rate": {}}}}}"#,
            number(Key::Mass(side)),
            number(Key::YawInertia(side)),
            pair(Key::CenterX(side), Key::CenterY(side)),
            pair(Key::BeforeX(side), Key::BeforeY(side)),
            number(Key::BeforeYawRate(side)),
            pair(Key::AfterX(side), Key::AfterY(side)),
            number(Key::AfterYawRate(side)),
        )
    };
    let resolution = if printed { r#", "resolution": {"v": 1e-9, "yaw_rate": 1e-9, "length": 1e-9, "energy": 1e-3}"# } else { "" };
    format!(
        r#"{{"id": "{}", "bodies": [{}, {}], "contact": {{"point": {}, "normal_angle": {}}}, "model": {{"restitution": {}, "impulse_ratio": {}, "ratio_kind": "friction"}}, "reported": {{"energy_loss": {}, "work_normal": {}, "work_tangential": {}, "delta_v": {}}}{resolution}}}"#,
        record.id,
        body(planar_impact::Side::One),
        body(planar_impact::Side::Two),
        pair(Key::PointX, Key::PointY),
        number(Key::NormalAngle),
        number(Key::Restitution),
        number(Key::ImpulseRatio),
        number(Key::EnergyLoss),
        number(Key::NormalWork),
        number(Key::TangentialWork),
        pair(Key::DeltaV(planar_impact::Side::One), Key::DeltaV(planar_impact::Side::Two)),
    )
}

const HEADER: &str = r#""schema": "planar-impact-record/1", "units": {"length": "m", "mass": "kg", "time": "s", "angle": "rad"}"#;

/// Returns the columns of a CSV file: those of the JSON above.
fn columns() -> Vec<Key> {
    let left_out = [
        "heading",
        "pdof",
        "ees",
        "kinetic",
        "impulse.",
        "speed",
        "moment",
        "duration",
        "after.cg",
        "after.p",
        "reported.impulse_ratio",
        "critical",
    ];
    Key::ALL.into_iter().filter(|key| !left_out.iter().any(|part| key.name().contains(part))).collect()
}

fn unit(key: Key) -> &'static str {
    use planar_impact::check::ResolutionGroup as Group;
    match key.group() {
        Group::Mass => "kg",
        Group::YawInertia => "kg m^2",
        Group::Length => "m",
        Group::Velocity => "m/s",
        Group::YawRate => "rad/s",
        Group::Angle => "rad",
        Group::Energy => "J",
        Group::Impulse => "N s",
        Group::MomentImpulse => "N m s",
        Group::Time => "s",
        Group::Restitution | Group::ImpulseRatio => "",
    }
}

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let count: u64 = arguments.first().and_then(|count| count.parse().ok()).unwrap_or(1000);
    let form = arguments.get(1).map_or("jsonl", String::as_str);
    let printed = arguments.get(2).is_some_and(|word| word == "printed");
    let mut numbers = Numbers(20_260_814);
    let mut to = BufWriter::new(io::stdout().lock());
    let columns = columns();
    let joined = |each: fn(Key) -> String| columns.iter().map(|key| format!(",{}", each(*key))).collect::<String>();
    let (of_names, of_units) = if printed { (",resolution.v,resolution.energy", ",m/s,J") } else { ("", "") };
    match form {
        "json" => writeln!(to, "{{{HEADER}, \"records\": [")?,
        "csv" => {
            writeln!(to, "id,model.ratio_kind{}{of_names}", joined(|key| key.name().to_owned()))?;
            writeln!(to, ",{}{of_units}", joined(|key| unit(key).to_owned()))?;
        }
        _ => writeln!(to, "{{{HEADER}}}")?,
    }
    for number in 1..=count {
        let record = numbers.record(number);
        match form {
            "json" => writeln!(to, "{}{}", json(&record, printed), if number < count { "," } else { "" })?,
            "csv" => {
                write!(to, "{},friction", record.id)?;
                for key in &columns {
                    write!(to, ",{}", record.get(*key).map_or(String::new(), |value| value.to_string()))?;
                }
                writeln!(to, "{}", if printed { ",1e-9,1e-3" } else { "" })?;
            }
            _ => writeln!(to, "{}", json(&record, printed))?,
        }
    }
    if form == "json" {
        writeln!(to, "]}}")?;
    }
    to.flush()
}
