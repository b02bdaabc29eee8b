//! Recordings of forces, accelerations, films and event data recorders: read, integrated, or refused.

use planar_impact_app::json::{self, Layout};
use planar_impact_app::record::{self, Recording};
use planar_impact_app::{Issues, Open, Source, Uncontrolled, decode};

use crate::bytes::Bytes;
use crate::cases;

/// Everything that must hold of a recording.
fn hold(name: &str, text: Vec<u8>, beside: String) -> Option<record::RecordAnswer> {
    let open: Open = Box::new(move |name| decode::source(name, beside.clone().into_bytes()));
    let read = decode::source(name, text).and_then(|source: Source| Recording::parse(source, &open));
    let answer: Result<_, Issues> = read.and_then(|recording| record::record(&[recording], &(), &Uncontrolled));
    match answer {
        Ok(answer) => {
            let text = json::text(&answer, Layout::Compact).unwrap_or_else(|issues| panic!("{issues}"));
            let _: serde_json::Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
            let _ = planar_impact_report::text::render(&planar_impact_report::page::page(&answer, planar_impact_app::Units::Si));
            if let Err(issues) = planar_impact_report::chart::record(&answer, planar_impact_app::Units::Us) {
                panic!("a chart is refused: {issues}");
            }
            answer.facts.records.into_iter().next()
        }
        Err(issues) => {
            cases::sound_refusal(&issues);
            None
        }
    }
}

/// The target: a rectangular pulse whose impulse is known, a description of any file beside it, or any text.
pub fn run(data: &[u8]) {
    let Some((&first, rest)) = data.split_first() else { return };
    match first % 4 {
        0 => pulse(&mut Bytes::new(rest)),
        1 => {
            let mut parts = rest.splitn(2, |byte| *byte == 0);
            let text = parts.next().unwrap_or_default().to_vec();
            let beside = String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
            hold("record.toml", text, beside);
        }
        _ => drop(hold("record.csv", rest.to_vec(), String::new())),
    }
}

/// Samples of a force, whose trapezoids are summed here; a calibration, a polarity and a second bank change it as they say.
fn pulse(from: &mut Bytes<'_>) {
    let (samples, scale) = (40 + from.below(200), from.one_of(&[1.0, 2.5, 50.0]));
    let (unit, size) = from.one_of(&[("N", 1.0), ("kN", 1000.0), ("lbf", 4.448_221_615_260_5)]);
    let forces: Vec<f64> = (0..samples)
        .map(|i| if (10..samples - 10).contains(&i) { (from.between(0.0, 400.0) * 10.0).round() / 10.0 } else { 0.0 })
        .collect();
    let mut csv = format!("time [ms],normal_force [{unit}]\n");
    for (i, force) in forces.iter().enumerate() {
        csv += &format!("{},{}\n", i as f64 * 0.5, force * scale);
    }
    let Some(answer) = hold("record.csv", csv.clone().into_bytes(), String::new()) else { return };
    let Some(impulse) = answer.barrier.and_then(|barrier| barrier.normal_impulse) else { return };
    let whole: f64 = forces.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0 * 0.5e-3 * scale * size).sum();
    let greatest: f64 = forces.iter().fold(0.0, |greatest, force| f64::max(greatest, force * scale * size));
    assert!(
        impulse.value.is_finite() && impulse.value.abs() <= whole + greatest * 1e-3 * samples as f64,
        "{impulse:?}, and the samples have {whole}\n{csv}"
    );
}
