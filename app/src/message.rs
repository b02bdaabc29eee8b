//! Sentences whose figures carry their measure, for answers and for printing in the reader's units.

use std::borrow::Cow;

pub use planar_impact::{Message, Part};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};

use crate::units::Units;

/// A message in an answer: in JSON its text in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Sentence(pub Message);

impl Serialize for Sentence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&Units::Si.sentence(&self.0))
    }
}

impl JsonSchema for Sentence {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Sentence".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}
