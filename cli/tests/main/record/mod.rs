//! Recordings: pulses with a closed form, clipped and truncated copies, recorders by hand, evidence from them, and bad inputs.

use std::f64::consts::PI;
use std::fmt::Write;

use serde_json::{Value, json};

use crate::process::{Folder, Run, run, run_with_input, workspace};

mod films;
mod pulses;
mod reading;
mod recorders;

/// The times of a test, 0.1 ms apart: 20 ms before a pulse of 100 ms, and 20 ms after it.
fn times() -> impl Iterator<Item = f64> {
    (-200..=1200).map(|i| f64::from(i) * 0.1)
}

/// A half-sine from 0 to 100 ms, of height 1.
fn pulse(ms: f64) -> f64 {
    if (0.0..=100.0).contains(&ms) { (PI * ms / 100.0).sin() } else { 0.0 }
}

/// A CSV of times in ms and of columns over them.
fn csv(header: &str, columns: &[&dyn Fn(f64) -> f64]) -> String {
    let mut text = format!("time [ms],{header}\n");
    for ms in times() {
        let cells: Vec<String> = columns.iter().map(|column| column(ms).to_string()).collect();
        writeln!(text, "{ms},{}", cells.join(",")).expect("a string takes everything");
    }
    text
}

/// Random numbers that are the same in each run.
struct Random(u64);

impl Random {
    /// Returns a number from 0 to 1.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a nearly normal number, of mean 0 and standard deviation 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Runs `record` on files of a folder, and returns its JSON.
fn records_of(folder: &Folder, names: &[String]) -> Value {
    let arguments: Vec<&str> = std::iter::once("record").chain(names.iter().map(String::as_str)).chain(["--format", "json"]).collect();
    let run = run(folder.path(), &arguments);
    serde_json::from_str(&run.out).unwrap_or_else(|_| panic!("{}", run.err))
}

fn close(found: &Value, wanted: f64, relative: f64) {
    let found = found.as_f64().unwrap_or(f64::NAN);
    assert!((found - wanted).abs() <= relative * wanted.abs().max(1e-12), "{found}, not {wanted}");
}

/// Runs `record` on a file beside `test.csv`, and returns its first record and the whole run.
fn record_of(samples: &str, settings: Option<&str>) -> (Value, Run) {
    let folder = Folder::new();
    folder.write("test.csv", samples.as_bytes());
    let file = settings.map_or("test.csv", |settings| {
        folder.write("test.toml", format!("schema = 1\nfile = \"test.csv\"\n{settings}").as_bytes());
        "test.toml"
    });
    let run = run(folder.path(), &["record", file, "--format", "json"]);
    let json: Value = serde_json::from_str(&run.out).unwrap_or(Value::Null);
    (json["records"][0].clone(), run)
}

/// A test of 1500 kg at 10 m/s: forces of 100 and 150 kN, a tangential one of 60 kN, half-sines all.
fn barrier() -> String {
    csv(
        "normal_force.a [kN],normal_force.b [kN],tangential_force [kN]",
        &[&|ms| 100.0 * pulse(ms) + 2.0, &|ms| 150.0 * pulse(ms) - 1.0, &|ms| 60.0 * pulse(ms) + 0.5],
    )
}

/// A recorder in whole km/h: forward −40, to the left 30 at last, and speeds to half a second before the impact.
fn recorder(last_speed: &str) -> String {
    let rise = [0.0, 0.05, 0.1, 0.3, 0.6, 0.8, 0.95, 1.0, 1.0, 1.0, 1.0];
    let mut text = format!("time [s],speed [km/h],delta_v_forward [km/h],delta_v_right [km/h]\n-1,60,,\n-0.5,54,,\n{last_speed}");
    for (i, share) in rise.iter().enumerate() {
        writeln!(text, "{},,{},{}", i as f64 * 0.01, (-40.0_f64 * share).round(), (-30.0_f64 * share).round())
            .expect("a string takes everything");
    }
    text
}

/// What lies between the samples of a half-sine of this height, duration and number of steps: its slope changes at both ends and a little at each sample within.
fn of_sampling(height: f64, duration: f64, steps: f64) -> f64 {
    let angle = PI / steps;
    let bends = 2.0 * angle.sin().powi(2) + steps / 2.0 * (2.0 - 2.0 * angle.cos()).powi(2);
    height * duration / steps * bends.sqrt() / 12.0
}

const CAR: &str = "mass = \"1500 kg ± 15 kg\"\nspeed = \"10 m/s ± 0.1 m/s\"\n";
/// The integral of a half-sine of 100 ms: 2 T/π.
const AREA: f64 = 0.2 / PI;
