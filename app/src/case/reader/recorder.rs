//! Evidence from recordings: `vehicle.N.recorder`, `contact.record`, and the restitution of a barrier test.

use std::path::{Component, Path, PathBuf};

use planar_impact::Side;
use planar_impact::barrier::Estimate;
use planar_impact::reconstruct::{Correlation, Measurand, Variable};
use planar_impact::{Input, Output};

use super::barrier_test::BarrierTest;
use super::evidence::Piece;
use super::fitted::report;
use super::measured::{Amount, Measured, Spread};
use super::{CaseReader, one_of};
use crate::case::correlation_of;
use crate::document::{Field, Table};
use crate::message::Message;
use crate::notice::Notice;
use crate::quantity::Kind;
use crate::record::{ACCELEROMETER_RANGE, Barrier, RecordAnswer, Recording, Uncertain, VelocityChange, samples_of};
use crate::units::trim;

/// What of a recorder may be evidence.
const USES: [&str; 5] = ["delta_v_forward", "delta_v_left", "delta_v_magnitude", "pdof", "speed"];

/// The restitution of a recording.
pub(crate) struct Recorded {
    pub(crate) restitution: f64,
    /// Its standard deviation.
    pub(crate) sd: f64,
    /// The closing speed that it was computed with, if the file gives one.
    pub(crate) speed: Option<Estimate>,
    /// The name of the file.
    pub(crate) file: String,
}

/// A recording that is evidence.
#[derive(Clone, Copy)]
pub(super) enum RecordingOf {
    Vehicle(Side),
    Contact,
}

impl RecordingOf {
    /// Returns the recording with this name in `[evidence]`.
    pub(super) fn named(name: &str) -> Option<Self> {
        match name {
            "vehicle.1.recorder" => Some(RecordingOf::Vehicle(Side::One)),
            "vehicle.2.recorder" => Some(RecordingOf::Vehicle(Side::Two)),
            "contact.record" => Some(RecordingOf::Contact),
            _ => None,
        }
    }

    /// Returns the input that it measures.
    pub(super) fn variable(self) -> Variable {
        match self {
            RecordingOf::Vehicle(side) => Variable::Speed(side),
            RecordingOf::Contact => Variable::Input(Input::Restitution),
        }
    }
}

impl CaseReader {
    /// Reads the pieces of evidence of a recording.
    pub(super) fn recorded<'a>(&self, of: RecordingOf, field: &Field<'a>, found: &mut Vec<Piece<'a>>) -> Option<()> {
        match of {
            RecordingOf::Vehicle(side) => self.recorder(field, side, found),
            RecordingOf::Contact => self.barrier_record(field, found),
        }
    }

    fn recorder<'a>(&self, field: &Field<'a>, side: Side, found: &mut Vec<Piece<'a>>) -> Option<()> {
        let table = field.clone().table()?;
        let positive = |key| match table.has(key) {
            true => self.positive(table.optional(key), Kind::SPEED).map(Some),
            false => Some(None),
        };
        let (resolution, range) = (positive("resolution"), positive("range"));
        let of_sensor = match table.has(ACCELEROMETER_RANGE) {
            true => self.positive_acceleration(table.optional(ACCELEROMETER_RANGE)).map(Some),
            false => Some(None),
        };
        let relative = if table.has("relative") { self.coefficient(table.optional("relative"), 1.0).map(Some) } else { Some(None) };
        let uses = if table.has("use") { uses(&table).map(Some) } else { Some(None) };
        let mut recording = self.recording_of(&table);
        let help = "a recorder is of one vehicle: leave it out of the other, or name the file of that one";
        let source = |key| Some(table.optional(key)).filter(|_| recording.is_some() && table.has(key));
        let is_first = ["file", "samples"].into_iter().filter_map(source).all(|source| self.counts_once(source, help));
        table.finish();
        let (resolution, range, relative, of_sensor, uses) = (resolution?, range?, relative?, of_sensor?, uses?);
        is_first.then_some(())?;
        recording.as_mut()?.set_recorder(resolution, relative, range, of_sensor);
        let answer = self.analysed(field, &recording?)?;
        let Some(recorder) = &answer.recorder else {
            let help = "name its columns delta_v_forward, delta_v_left or delta_v_right, and speed".to_owned();
            field.report("the file has no channel of a recorder", Some(help));
            return None;
        };
        let at_maximum = |of: fn(&VelocityChange) -> Uncertain| recorder.maximum.as_ref().map(of);
        let forward = at_maximum(|maximum| maximum.forward).or(recorder.delta_v_forward.map(|at| at.number));
        let left = at_maximum(|maximum| maximum.left).or(recorder.delta_v_left.map(|at| at.number));
        let all = [
            (Measurand::DeltaVForward(side), forward),
            (Measurand::DeltaVLeft(side), left),
            (Measurand::Output(Output::DeltaVMagnitude(side)), at_maximum(|maximum| maximum.magnitude)),
            (Measurand::Output(Output::PrincipalDirectionOfForce(side)), recorder.maximum.and_then(|maximum| maximum.pdof)),
            (Measurand::Variable(Variable::Speed(side)), recorder.speed_at_impact.map(|at| at.number)),
        ];
        let mut sound = true;
        for ((of, number), key) in all.into_iter().zip(USES) {
            // Magnitude and direction repeat the components, so they are used only on request.
            let usual = number.is_some() && !["delta_v_magnitude", "pdof"].contains(&key);
            if !uses.as_ref().map_or(usual, |uses| uses.contains(&key)) {
                continue;
            }
            let Some(number) = number else {
                field.report(format!("{} does not record {key}", answer.file), Some("leave it out of `use`".to_owned()));
                sound = false;
                continue;
            };
            if recorder.is_lower_bound && key != "speed" {
                let bounds = answer.channels.iter().filter(|channel| channel.clipped.is_some() || channel.is_truncated);
                let mut names: Vec<&str> = bounds.map(|channel| channel.name.as_str()).collect();
                let of_sensors = recorder.clipped_sensors.iter().map(|sensor| sensor.channel.as_str());
                names.extend(of_sensors.filter(|name| !names.contains(name)).collect::<Vec<_>>());
                let message =
                    format!("{} of {} is clipped or truncated: {key} is a lower bound, not a value", names.join(", "), answer.file);
                let rest = match recorder.speed_at_impact {
                    Some(_) => "give use = [\"speed\"] to leave the velocity change out",
                    None => "leave the recorder out, whose velocity change is all that it tells",
                };
                field.report_as(
                    "clipped",
                    message,
                    Some(format!("`planar-impact record` shows it, and a `range` of its `[[channel]]` says that it is whole; {rest}")),
                );
                return None;
            }
            sound &= self.push(field, of, key, number, found).is_some();
        }
        if uses.is_some_and(|uses| ["delta_v_magnitude", "pdof"].iter().all(|key| uses.contains(key))) {
            self.correlations_of_evidence
                .borrow_mut()
                .extend(recorder.maximum.as_ref().and_then(|maximum| of_magnitude_and_direction(side, maximum)));
        }
        sound.then_some(())
    }

    fn barrier_record<'a>(&self, field: &Field<'a>, found: &mut Vec<Piece<'a>>) -> Option<()> {
        let table = field.clone().table()?;
        let recording = self.recording_of(&table);
        table.finish();
        let recording = recording?;
        let answer = self.analysed(field, &recording)?;
        let ratio = answer.barrier.as_ref().and_then(|barrier| barrier.impulse_ratio);
        let restitution = restitution(&answer);
        if ratio.is_none() && restitution.is_none() {
            let help = "it needs both banks of force, or a restitution: mass and speed of the vehicle, or a film".to_owned();
            field.report(format!("{} has neither an impulse ratio nor a restitution", answer.file), Some(help));
            return None;
        }
        if restitution.as_ref().is_some_and(|restitution| !is_lawful(field, &answer, restitution.value)) {
            return None;
        }
        let (followed, of_center) = (recording.followed(), restitution_of_center(&answer).filter(|_| answer.kinematics.is_none()));
        if followed.is_some() || of_center.is_some() {
            let (file, mass) = (answer.file.clone(), recording.mass());
            let speed = followed.as_ref().map_or(recording.speed(), |followed| Some(followed.speed));
            *self.barrier_test.borrow_mut() = Some(BarrierTest { of_center, ratio, file, mass, speed, followed });
        }
        let pieces = [
            (Measurand::Output(Output::ImpulseRatio), "impulse_ratio", ratio),
            (Measurand::Variable(Variable::Input(Input::Restitution)), "restitution", restitution),
        ];
        self.correlations_of_evidence.borrow_mut().extend(of_ratio_and_restitution(&answer));
        let read = pieces.into_iter().filter_map(|(of, key, number)| Some(self.push(field, of, key, number?, found)));
        read.collect::<Vec<_>>().into_iter().collect()
    }

    /// Reads { record = "file" } in place of a restitution.
    pub(crate) fn recorded_restitution(&self, field: &Field<'_>) -> Option<Recorded> {
        let table = field.clone().table()?;
        let record = table.required("record");
        let recording = self.recording_at(record.clone());
        table.finish();
        let recording = recording?;
        self.counts_once(record, "a recording is of one test: give this test its own, or restitution and restitution_sd").then_some(())?;
        let answer = self.analysed(field, &recording)?;
        let Some(Uncertain { value, sd }) = restitution(&answer) else {
            let help = "it needs mass and speed with forces, speed with an acceleration, or a film".to_owned();
            field.report(format!("{} has no restitution", answer.file), Some(help));
            return None;
        };
        if !is_lawful(field, &answer, value) {
            return None;
        }
        let Some(sd) = sd else {
            let help = "record the unloaded channels before the contact, or give `restitution` and `restitution_sd`".to_owned();
            field.report(format!("the restitution of {} has no standard deviation", answer.file), Some(help));
            return None;
        };
        Some(Recorded { restitution: value, sd, speed: recording.speed(), file: answer.file })
    }

    /// Reports a recording that another test or vehicle has, by its file or its samples: a fit would count its error as several that are independent.
    fn counts_once(&self, record: Field<'_>, help: &str) -> bool {
        let Some(name) = record.clone().string() else { return false };
        let path: PathBuf = Path::new(name).components().filter(|part| *part != Component::CurDir).collect();
        let mut all = self.records.borrow_mut();
        if let Some((_, first)) = all.iter().find(|(known, _)| *known == path) {
            record.report_as("contradiction", format!("{first} has the same recording, which would count twice"), Some(help.to_owned()));
            return false;
        }
        all.push((path, record.path().to_owned()));
        true
    }

    /// Reads the recording that `file` names, or whose `samples` stand in the case itself.
    fn recording_of(&self, table: &Table<'_>) -> Option<Recording> {
        if one_of(table, "file", "samples")? == "file" {
            return self.recording_at(table.required("file"));
        }
        let field = table.required("samples");
        let source = samples_of(field.clone())?;
        Recording::of_samples(source).map_err(|issues| report(&field, &issues)).ok()
    }

    fn recording_at(&self, field: Field<'_>) -> Option<Recording> {
        let (place, name) = (field.clone(), field.clone().string()?.to_owned());
        let source = self.opened(field, "give the values in the file itself")?;
        // A recording may name its samples, which lie beside it.
        let folder = Path::new(&name).parent().map(Path::to_path_buf).unwrap_or_default();
        Recording::parse_by(source, |name| self.open_at(&folder.join(name))).map_err(|issues| report(&place, &issues)).ok()
    }

    fn analysed(&self, field: &Field<'_>, recording: &Recording) -> Option<RecordAnswer> {
        let (answer, notices) = recording.analyse().map_err(|issues| report(field, &issues)).ok()?;
        let path = field.path().to_owned();
        let at_path = |notice: Notice| {
            let message = Message::from(format!("{path}: ")).join(notice.message);
            Notice { path: path.clone(), message, ..notice }
        };
        self.notices.borrow_mut().extend(recording.notices.0.iter().cloned().chain(notices).map(at_path));
        Some(answer)
    }

    fn push<'a>(&self, field: &Field<'a>, of: Measurand, key: &str, number: Uncertain, found: &mut Vec<Piece<'a>>) -> Option<()> {
        let Some(sd) = number.sd.filter(|sd| *sd > 0.0) else {
            let help = match of {
                Measurand::Output(Output::ImpulseRatio) | Measurand::Variable(Variable::Input(Input::Restitution)) => {
                    "begin the samples before the contact, at times below zero while the channels are unloaded"
                }
                _ => "give `resolution`: the step in which the recorder stores speeds",
            };
            field.report(format!("the standard deviation of {key} is not known"), Some(help.to_owned()));
            return None;
        };
        let measured = Measured { amount: Amount::Number(number.value), spread: Spread::StandardDeviation(sd) };
        found.push(Piece::new(of, field.clone(), measured));
        Some(())
    }
}

fn uses(table: &Table<'_>) -> Option<Vec<&'static str>> {
    let field = table.optional("use");
    let place = field.clone();
    let items = field.items(&format!("an array of {}", USES.join(", ")), 1..=USES.len())?;
    let chosen: Vec<&str> = items.into_iter().map(|item| item.choice(&USES)).collect::<Option<_>>()?;
    let has = |keys: [&str; 2]| keys.iter().any(|key| chosen.contains(key));
    if has(["delta_v_forward", "delta_v_left"]) && has(["delta_v_magnitude", "pdof"]) {
        let help = "use the components, or magnitude and pdof".to_owned();
        place.report_as(
            "contradiction",
            "magnitude and direction say the same as the components: the record would count twice",
            Some(help),
        );
        return None;
    }
    Some(chosen)
}

/// Returns the correlation of the magnitude m of a velocity change with its direction, which have the errors of the same components f and l forward and to the left: with
/// m² = f² + l² and the direction atan2(l, −f) the covariance is f l (σ_f² − σ_l²)/m³.
fn of_magnitude_and_direction(side: Side, maximum: &VelocityChange) -> Option<Correlation> {
    let VelocityChange { forward, left, magnitude, pdof, .. } = maximum;
    let sds = [magnitude.sd?, pdof.as_ref()?.sd?];
    let (of_forward, of_left) = (forward.sd?, left.sd?);
    let size = magnitude.value;
    let covariance = forward.value * left.value * (of_forward * of_forward - of_left * of_left) / (size * size * size);
    let pair = [Output::DeltaVMagnitude(side), Output::PrincipalDirectionOfForce(side)].map(Measurand::Output);
    // Nothing has no direction.
    if size > 0.0 { correlation_of(pair, covariance, sds) } else { None }
}

/// Returns the correlation of the impulse ratio of load cells with their restitution: with the normal impulse P, the one is P_t/P and the other P/(m v) − 1, so that an
/// error of P by σ adds −μ (1 + e) σ²/P² to their covariance.
fn of_ratio_and_restitution(answer: &RecordAnswer) -> Option<Correlation> {
    let barrier = answer.barrier.as_ref()?;
    let (ratio, of_cells, impulse) = (barrier.impulse_ratio?, barrier.restitution?, barrier.normal_impulse?);
    let sds = [ratio.sd?, of_cells.sd?];
    let share = impulse.sd? / impulse.value;
    let covariance = -ratio.value * (1.0 + of_cells.value) * share * share;
    let is_used = restitution(answer).is_some_and(|used| used == of_cells);
    let pair = [Measurand::Output(Output::ImpulseRatio), Measurand::Variable(Variable::Input(Input::Restitution))];
    if is_used { correlation_of(pair, covariance, sds) } else { None }
}

/// Returns `true` for a restitution from 0 to 1, and reports another.
fn is_lawful(field: &Field<'_>, answer: &RecordAnswer, restitution: f64) -> bool {
    let is_lawful = (0.0..=1.0).contains(&restitution);
    if !is_lawful {
        let message = format!("the restitution of {} is {}; it must be from 0 to 1", answer.file, trim(restitution));
        let help = "`planar-impact record` shows what it follows from: check the speed, the mass and the window".to_owned();
        field.report_as("out-of-range", message, Some(help));
    }
    is_lawful
}

/// Returns the restitution that a recording has: that of the contact point by kinematics, or else that of the center of mass, or of a film.
fn restitution(answer: &RecordAnswer) -> Option<Uncertain> {
    let of_kinematics = answer.kinematics.as_ref().map(|kinematics| kinematics.restitution);
    of_kinematics.or_else(|| restitution_of_center(answer)).or_else(|| answer.films.first().map(|film| film.restitution))
}

/// Returns the restitution of the center of mass, of load cells, or else of an acceleration.
fn restitution_of_center(answer: &RecordAnswer) -> Option<Uncertain> {
    let of_cells = answer.barrier.as_ref().and_then(|barrier: &Barrier| barrier.restitution);
    of_cells.or_else(|| answer.accelerations.iter().find_map(|one| one.restitution))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;

    /// Load cells of a barrier, with noise of either bank.
    fn answer(tangential: f64, noise: [f64; 2], mass: &str) -> RecordAnswer {
        let row = |i: i32| {
            let force = if (0..100).contains(&i) { 300.0 * (f64::from(i) * std::f64::consts::PI / 100.0).sin() } else { 0.0 };
            let by = f64::from((i * 7919).rem_euclid(11)) - 5.0;
            format!("{i},{},{}\n", force + noise[0] * by, tangential * force + noise[1] * by)
        };
        let rows: String = (-60..=130).map(row).collect();
        let samples = format!("time [ms],normal_force.a [kN],tangential_force.b [kN]\n{rows}");
        let text = format!("schema = 1\nfile = \"a.csv\"\nmass = {mass}\nspeed = 10\n");
        let open = move |_: &std::path::Path| Ok(Source::new("a.csv", samples.clone()));
        let recording = Recording::parse_by(Source::new("a.toml", text), open).unwrap_or_else(|issues| panic!("{issues}"));
        recording.analyse().unwrap_or_else(|issues| panic!("{issues}")).0
    }

    fn coefficient(answer: &RecordAnswer) -> f64 {
        of_ratio_and_restitution(answer).map_or(0.0, |correlation| correlation.coefficient)
    }

    #[test]
    fn an_error_of_the_normal_impulse_is_one_of_ratio_and_restitution() {
        for tangential in [0.3, -0.3] {
            let of_normal = coefficient(&answer(tangential, [3.0, 0.001], "1500"));
            assert!(of_normal * tangential.signum() < -0.9999, "{tangential}: {of_normal}");
            let of_tangential = coefficient(&answer(tangential, [0.001, 3.0], "1500"));
            assert!(of_tangential.abs() < 0.01, "{tangential}: {of_tangential}");
        }
        // With half of the variance of the ratio from the tangential bank, and all of that of the restitution from the normal one, it is the root of a half.
        let half = coefficient(&answer(0.3, [3.0, 0.9], "1500"));
        assert!((half.abs() - 0.5_f64.sqrt()).abs() < 0.01, "{half}");
        // An uncertain mass is no error of the ratio.
        let of_mass = coefficient(&answer(0.3, [0.3, 0.001], "\"1500 kg ± 300 kg\""));
        assert!(of_mass.abs() < 0.1, "{of_mass}");
    }
}
