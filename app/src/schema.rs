//! JSON Schemas of case files, of barrier tests, of recordings, and of each answer.

mod quantities;

use schemars::{Schema, schema_for};
use serde_json::Value;

use crate::answer::Answer;
use crate::check::{CheckReport, rules::Rules};
use crate::compare::CaseComparison;
use crate::crash3::Comparison;
use crate::crush::CrushAnswer;
use crate::formula::Formula;
use crate::gradient::Gradient;
use crate::prove::ProofReport;
use crate::reconstruct::Reconstruction;
use crate::record::Records;
use crate::scene::Scene;
use crate::slide::Slides;
use crate::solve::Solution;
use crate::stiffness::StiffnessAnswer;
use crate::sweep::Sweep;
use crate::uncertainty::Uncertainty;
use crate::validate::Validation;

/// A name and the function that generates its schema.
type Named = (&'static str, fn() -> Schema);

/// Everything that has a schema.
const SCHEMAS: [Named; 20] = [
    ("case", || embedded(include_str!("schema/case.json"))),
    ("tests", || embedded(include_str!("schema/tests.json"))),
    ("recording", || embedded(include_str!("schema/recording.json"))),
    ("solve", || schema_for!(Answer<Solution>)),
    ("gradient", || schema_for!(Answer<Gradient>)),
    ("sweep", || schema_for!(Answer<Sweep>)),
    ("crush", || schema_for!(Answer<CrushAnswer>)),
    ("crash3", || schema_for!(Answer<Comparison>)),
    ("reconstruct", || schema_for!(Answer<Reconstruction>)),
    ("record", || schema_for!(Answer<Records>)),
    ("slide", || schema_for!(Answer<Slides>)),
    ("draw", || schema_for!(Answer<Scene>)),
    ("uncertainty", || schema_for!(Answer<Uncertainty>)),
    ("stiffness", || schema_for!(Answer<StiffnessAnswer>)),
    ("compare", || schema_for!(Answer<CaseComparison>)),
    ("formula", || schema_for!(Formula)),
    ("check", || schema_for!(CheckReport<'static>)),
    ("rules", || schema_for!(Rules)),
    ("prove", || schema_for!(ProofReport)),
    ("validate", || schema_for!(Validation)),
];

/// Parses an embedded schema file and adds the quantities that it refers to.
fn embedded(text: &str) -> Schema {
    let mut schema: Schema = serde_json::from_str(text).unwrap_or_default();
    if let Some(Value::Object(definitions)) = schema.get_mut("$defs") {
        definitions.append(&mut quantities::definitions(text));
    }
    schema
}

/// Returns the names of everything that has a schema: `case`, `tests`, `recording` and the verbs.
pub fn names() -> [&'static str; SCHEMAS.len()] {
    SCHEMAS.map(|(name, _)| name)
}

/// Returns the schema of case files, of barrier tests, of recordings, or of the answer of a verb; `None` for any other name.
///
/// ```
/// let schema = planar_impact_app::schema::of("solve").expect("a verb");
/// assert!(schema.get("properties").is_some());
/// ```
pub fn of(name: &str) -> Option<Schema> {
    SCHEMAS.iter().find(|(known, _)| *known == name).map(|(_, schema)| schema())
}
