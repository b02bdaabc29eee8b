//! Answers as arrays.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, StringArray};
use arrow_buffer::NullBuffer;
use planar_impact_app::batch::{Answer, Refused, RowWarning};

/// Returns the columns of an answer in the order of their names, its refusals and its warnings.
pub fn arrays(answer: Answer, rows: usize) -> (Vec<ArrayRef>, Vec<Refused>, Vec<RowWarning>) {
    let Answer { outputs, derivatives, check, refused, warnings } = answer;
    let mut codes: Vec<Option<&str>> = vec![None; rows];
    refused.iter().for_each(|refused| codes[refused.row] = Some(&refused.codes));
    let codes = Arc::new(StringArray::from(codes));
    let numbers = outputs.into_iter().chain(derivatives).map(nullable);
    let check = check.map(|check| Arc::new(StringArray::from(check)) as ArrayRef);
    (numbers.chain(check).chain([codes as ArrayRef]).collect(), refused, warnings)
}

/// A number that is not there is NaN in an answer.
fn nullable(numbers: Vec<f64>) -> ArrayRef {
    let has_gaps = numbers.iter().any(|number| number.is_nan());
    let gaps = has_gaps.then(|| NullBuffer::from_iter(numbers.iter().map(|number| !number.is_nan())));
    Arc::new(Float64Array::new(numbers.into(), gaps))
}
