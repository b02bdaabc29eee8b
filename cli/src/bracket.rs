//! What the bracket of the crush plane makes of the answers: both ends beside the nominal plane.

use planar_impact::{CrushPlaneBracket, Input, Output, Refusal, Refusals, Side};
use serde::Serialize;

use crate::case::{Answer, Answers, Case, Parameter};
use crate::derivative;
use crate::named::{Named, plain};
use crate::table::{self, Align, wrap};
use crate::units::{Measure, Units};
use crate::wording;

const CRUSH_PLANE: Parameter = Parameter::Input(Input::CrushPlane);

/// The answers at both ends of the bracket, and their derivatives at the nominal crush plane.
pub struct Bracket<'a> {
    case: &'a Case,
    nominal: Answers,
    ends: [End; 2],
}

struct End {
    crush_plane: f64,
    answers: Result<Answers, Refusals>,
}

/// The bracket as JSON.
#[derive(Debug, Serialize)]
pub struct Document {
    lower: EndDocument,
    upper: EndDocument,
    /// The derivatives by the crush plane at the nominal one.
    d: Named<f64>,
}

#[derive(Debug, Serialize)]
struct EndDocument {
    crush_plane: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    outputs: Option<Named<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
}

impl<'a> Bracket<'a> {
    /// Of a case that gives the surfaces that meet, and is not refused between them.
    pub fn of(case: &'a Case, bracket: &CrushPlaneBracket, nominal: Answers) -> Self {
        let ends = [bracket.lower(), bracket.upper()].map(|crush_plane| {
            let answers = case.inputs.set_all(&[(CRUSH_PLANE, crush_plane)]).as_given().solve();
            End { crush_plane, answers }
        });
        Bracket { case, nominal, ends }
    }

    fn derivative(&self, answer: Answer) -> f64 {
        derivative::by(&self.case.inputs, CRUSH_PLANE).get(answer).map_or(f64::NAN, |dual| plain(dual.eps))
    }

    /// As other tools read it.
    pub fn document(&self) -> Document {
        let answers = self.case.setup.answers();
        let end = |end: &End| EndDocument {
            crush_plane: end.crush_plane,
            outputs: end.answers.as_ref().ok().map(|at| {
                let value = |&answer| at.get(answer).map(|value| (answer, plain(value)));
                answers.iter().filter_map(value).collect()
            }),
            refused: end.answers.as_ref().err().map(|refusals| reasons(refusals, Units::Si)),
        };
        let derivatives = answers.iter().map(|&answer| (answer, self.derivative(answer))).collect();
        Document { lower: end(&self.ends[0]), upper: end(&self.ends[1]), d: derivatives }
    }

    /// As a person reads it.
    pub fn render(&self, units: Units) -> String {
        let angle = |angle: f64| units.number(Measure::Angle, angle, 0.0);
        let nominal = angle(self.case.inputs.contact.crush_plane);
        let [lower, upper] = &self.ends;
        let mut rows = vec![row(["crush plane Gamma", "deg", &angle(lower.crush_plane), &nominal, &angle(upper.crush_plane), ""])];
        for (what, answer) in shown() {
            let measure = answer.measure();
            let scale = self.nominal.scale(measure);
            let number = |value: f64| units.number(measure, value, scale);
            let cell = |answers: &Answers| answers.get(answer).map(number).unwrap_or_default();
            let end = |end: &End| end.answers.as_ref().map_or_else(|_| "refused".to_owned(), cell);
            let slope = number(self.derivative(answer).to_radians());
            rows.push(row([what, units.unit(measure), &end(lower), &cell(&self.nominal), &end(upper), &slope]));
        }
        let columns = [Align::Left, Align::Left, Align::Right, Align::Right, Align::Right, Align::Right];
        let mut text = table::render(&["between the surfaces", "unit", "lower", "nominal", "upper", "per deg"], &columns, &rows);
        text.push('\n');
        for end in &self.ends {
            if let Err(refusals) = &end.answers {
                text.push_str(&wrap(&format!("{}.", reasons(refusals, units)), &format!("Refused at {} deg: ", angle(end.crush_plane))));
            }
        }
        text
    }
}

fn row(cells: [&str; 6]) -> Vec<String> {
    cells.map(str::to_owned).into()
}

fn reasons(refusals: &Refusals, units: Units) -> String {
    let reason = |refusal: &Refusal| wording::refusal(refusal, units).1;
    refusals.reasons().iter().map(reason).collect::<Vec<_>>().join("; ")
}

fn shown() -> [(&'static str, Answer); 9] {
    use Side::{One, Two};
    [
        ("normal work W_n", Answer::Impact(Output::NormalWork)),
        ("tangential work W_t", Answer::Impact(Output::TangentialWork)),
        ("energy loss T_L", Answer::Impact(Output::Loss)),
        ("impulse ratio mu", Answer::Impact(Output::ImpulseRatio)),
        ("critical impulse ratio mu0", Answer::Impact(Output::CriticalImpulseRatio)),
        ("delta-V, vehicle 1", Answer::Impact(Output::DeltaVMagnitude(One))),
        ("delta-V, vehicle 2", Answer::Impact(Output::DeltaVMagnitude(Two))),
        ("yaw rate after, vehicle 1", Answer::Impact(Output::YawRate(One))),
        ("yaw rate after, vehicle 2", Answer::Impact(Output::YawRate(Two))),
    ]
}
