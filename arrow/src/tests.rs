//! Schemas and types.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::builder::StringDictionaryBuilder;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{
    Array, ArrayRef, BinaryArray, BooleanArray, Decimal128Array, DictionaryArray, Float32Array, Float64Array, Int32Array, Int64Array,
    LargeStringArray, NullArray, RecordBatch, StringArray, StringViewArray, UInt8Array,
};
use arrow_schema::{DataType, Field, Schema};
use planar_impact_app::{Case, Source};

use crate::plan::UNIT;
use crate::{Options, Plan};

fn case() -> Case {
    let text = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 15\nimpact_center = [2, 0.3]\n[[vehicle]]\nbarrier = true\n\
                [contact]\ncrush_plane = 0\nrestitution = 0.1\n";
    Case::parse(Source::new("case.toml", text)).expect("a case")
}

fn of(names: &[&str]) -> Options {
    Options { of: names.iter().map(|name| (*name).to_owned()).collect(), ..Options::default() }
}

fn table(columns: Vec<(&str, ArrayRef)>) -> RecordBatch {
    RecordBatch::try_from_iter_with_nullable(columns.into_iter().map(|(name, array)| (name, array, true))).expect("columns of one length")
}

fn losses(table: &RecordBatch) -> Vec<Option<f64>> {
    let plan = Plan::of(table.schema_ref(), Some(&case()), &of(&["T_L"])).expect("a plan");
    let answer = plan.solve(table).expect("a table of its schema");
    assert_eq!(answer.schema(), plan.schema());
    answer["energy.loss"].as_primitive::<Float64Type>().iter().collect()
}

#[test]
fn a_number_is_the_same_in_every_type() {
    let text = [Some("12"), None, Some("15")];
    let number = [Some(12.0), None, Some(15.0)];
    let mut words = StringDictionaryBuilder::<Int32Type>::new();
    text.iter().for_each(|text| words.append_option(*text));
    let numbered =
        |values: ArrayRef| -> ArrayRef { Arc::new(DictionaryArray::new(Int32Array::from_iter([Some(1), None, Some(0)]), values)) };
    let decimals = |numbers: [i128; 2]| Decimal128Array::from_iter_values(numbers).with_precision_and_scale(10, 2).expect("a decimal");
    let columns: Vec<ArrayRef> = vec![
        Arc::new(Float64Array::from_iter(number)),
        numbered(Arc::new(Float64Array::from_iter_values([15.0, 12.0]))),
        numbered(Arc::new(Int64Array::from_iter_values([15, 12]))),
        numbered(Arc::new(decimals([1500, 1200]))),
        Arc::new(Float32Array::from_iter(number.map(|number| number.map(|number| number as f32)))),
        Arc::new(Int64Array::from_iter([Some(12), None, Some(15)])),
        Arc::new(UInt8Array::from_iter([Some(12), None, Some(15)])),
        Arc::new(Decimal128Array::from_iter([Some(1200), None, Some(1500)]).with_precision_and_scale(10, 2).expect("a decimal")),
        Arc::new(StringArray::from_iter(text)),
        Arc::new(LargeStringArray::from_iter(text)),
        Arc::new(StringViewArray::from_iter(text)),
        Arc::new(words.finish()),
    ];
    let first = losses(&table(vec![("vehicle.1.speed", columns[0].clone())]));
    assert!(first[0] < first[1] && first[1] == first[2] && first[0] > Some(0.0), "an empty cell is 15 m/s: {first:?}");
    for column in columns {
        assert_eq!(losses(&table(vec![("vehicle.1.speed", column.clone())])), first, "{}", column.data_type());
    }
    assert_eq!(losses(&table(vec![("vehicle.1.speed", Arc::new(NullArray::new(3)))])), [first[1]; 3]);
}

/// The digits of a decimal are rounded once, as those of a text are: 128 bits are more than a float has.
#[test]
fn a_decimal_is_rounded_once() {
    const SCALE: usize = 20;
    let digits = (0..200_i128).map(|i| 12 * 10_i128.pow(SCALE as u32) + i * 1_234_567_890_123_456_789);
    let text =
        digits.clone().map(|digits| format!("{}.{:0SCALE$}", digits / 10_i128.pow(SCALE as u32), digits % 10_i128.pow(SCALE as u32)));
    let decimals = Decimal128Array::from_iter(digits.map(Some)).with_precision_and_scale(38, SCALE as i8).expect("a decimal");
    let columns: [ArrayRef; 2] = [Arc::new(decimals), Arc::new(StringArray::from_iter(text.map(Some)))];
    let [decimals, texts] = columns.map(|column| losses(&table(vec![("vehicle.1.speed", column)])));
    assert_eq!(decimals, texts);
}

#[test]
fn a_truth_is_a_word() {
    let barrier: ArrayRef = Arc::new(BooleanArray::from_iter([Some(true), None, Some(false)]));
    let found = losses(&table(vec![("vehicle.2.barrier", barrier)]));
    assert!(found[0] > Some(0.0) && found[0] == found[1] && found[2].is_none(), "{found:?}");
}

#[test]
fn a_unit_is_in_the_name_or_in_the_metadata() {
    let speeds: ArrayRef = Arc::new(Float64Array::from(vec![54.0]));
    let bracketed = losses(&table(vec![("vehicle.1.speed [km/h]", speeds.clone())]));
    let field = |name: &str, unit: &str| {
        Field::new(name, DataType::Float64, true).with_metadata(HashMap::from([(UNIT.to_owned(), unit.to_owned())]))
    };
    let schema = |field: Field| Arc::new(Schema::new(vec![field]));
    let with_metadata = |field: Field| RecordBatch::try_new(schema(field), vec![speeds.clone()]).expect("a table");
    assert_eq!(losses(&with_metadata(field("vehicle.1.speed", "km/h"))), bracketed);
    assert_eq!(losses(&with_metadata(field("vehicle.1.speed [km/h]", "km/h"))), bracketed);
    assert_ne!(losses(&with_metadata(field("vehicle.1.speed", "m/s"))), bracketed);
    // A unit that was not read would make a number of km/h one of m/s.
    for key in ["Unit", "UNITS", " units ", "UoM"] {
        let field = Field::new("vehicle.1.speed", DataType::Float64, true);
        let field = field.with_metadata(HashMap::from([(key.to_owned(), "km/h".to_owned())]));
        assert_eq!(losses(&with_metadata(field)), bracketed, "{key}");
    }
    let wrong = |field: Field| Plan::of(&schema(field), Some(&case()), &of(&["T_L"])).expect_err("a wrong unit").list()[0].code;
    assert_eq!(wrong(field("vehicle.1.speed [km/h]", "m/s")), "invalid-unit");
    assert_eq!(wrong(field("vehicle.1.speed", "kg")), "invalid-unit");
    // Two keys may say the same, and no more than that.
    let both = |other: &str| {
        let units = [(UNIT, "km/h"), ("Units", other)].map(|(key, unit)| (key.to_owned(), unit.to_owned()));
        Field::new("vehicle.1.speed", DataType::Float64, true).with_metadata(HashMap::from(units))
    };
    assert_eq!(losses(&with_metadata(both("km/h"))), bracketed);
    assert_eq!(wrong(both("mph")), "invalid-unit");
    assert_eq!(wrong(Field::new("vehicle.1.speed", DataType::Binary, true)), "wrong-type");
}

#[test]
fn other_columns_pass_through() {
    let bytes: ArrayRef = Arc::new(BinaryArray::from_vec(vec![b"a", b"\xff"]));
    let truth: ArrayRef = Arc::new(BooleanArray::from(vec![true, false]));
    let table = table(vec![
        ("photo", bytes.clone()),
        ("vehicle.1.speed", Arc::new(StringArray::from(vec!["12", "fast"]))),
        ("m1", truth.clone()),
        ("contact.impulse_ratio", Arc::new(StringArray::from(vec!["critical", "0.1"]))),
    ]);
    let options = Options { wrt: vec!["v1".to_owned()], check: true, ..of(&["T_L", "Omega1"]) };
    let plan = Plan::of(table.schema_ref(), Some(&case()), &options).expect("a plan");
    let answer = plan.solve(&table).expect("an answer");
    let schema = answer.schema();
    let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
    assert_eq!(
        names,
        [
            "photo",
            "vehicle.1.speed",
            "m1",
            "contact.impulse_ratio",
            "energy.loss",
            "result.vehicle.1.yaw_rate",
            "d energy.loss / d vehicle.1.speed",
            "d result.vehicle.1.yaw_rate / d vehicle.1.speed",
            "check",
            "refusal"
        ]
    );
    assert_eq!((&answer.columns()[0], &answer.columns()[2]), (&bytes, &truth));
    assert_eq!(&answer.columns()[1], &table.columns()[1]);
    assert_eq!(schema.field(4).metadata()[UNIT], "J");
    assert_eq!(answer["refusal"].as_string::<i32>().iter().collect::<Vec<_>>(), [None, Some("unreadable")]);
    assert!(answer.columns()[4..8].iter().all(|column| column.is_valid(0) && column.is_null(1)));
    assert!(answer["check"].is_null(0) && answer["check"].is_null(1));

    let typed = plan.with_numbers();
    let answer = typed.solve(&table).expect("an answer");
    assert_eq!(answer.schema(), typed.schema());
    assert_eq!(answer["vehicle.1.speed"].as_primitive::<Float64Type>().iter().collect::<Vec<_>>(), [Some(12.0), None]);
    assert_eq!(answer["contact.impulse_ratio"].data_type(), &DataType::Utf8, "a ratio may be a word");
}

#[test]
fn a_table_of_another_schema_is_refused() {
    let numbers: ArrayRef = Arc::new(Float64Array::from(vec![1.0]));
    let one = table(vec![("vehicle.1.speed", numbers.clone())]);
    let other = table(vec![("vehicle.1.mass", numbers)]);
    let plan = Plan::of(one.schema_ref(), Some(&case()), &of(&["T_L"])).expect("a plan");
    assert!(plan.solve(&other).is_err());
    assert_eq!(plan.solve(&one.slice(0, 0)).map(|empty| empty.num_rows()).ok(), Some(0));
}
