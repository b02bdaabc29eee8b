//! Arrays as the cells of an input.

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array};
use arrow_cast::cast;
use arrow_schema::{ArrowError, DataType};
use planar_impact_app::batch::{Cell, Column, InputColumn};

/// Returns `true` if an input can be of this type.
pub fn is_readable(data_type: &DataType) -> bool {
    match data_type {
        DataType::Boolean | DataType::Null => true,
        DataType::Dictionary(_, values) => values.is_numeric() || is_text(values),
        _ => data_type.is_numeric() || is_text(data_type),
    }
}

/// Returns `true` if every value of this type is text.
pub fn is_text(data_type: &DataType) -> bool {
    match data_type {
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => true,
        DataType::Dictionary(_, values) => is_text(values),
        _ => false,
    }
}

/// Returns the cells of an input.
///
/// # Errors
///
/// If the array cannot be converted to numbers or text.
pub fn read<'a>(column: &InputColumn, array: &'a ArrayRef) -> Result<Column<'a>, ArrowError> {
    // What another library hands over need not be the text that it says.
    if is_text(array.data_type()) {
        array.to_data().validate_full()?;
    }
    match array.data_type() {
        DataType::Float64 if array.null_count() == 0 => Ok(column.of_numbers(array.as_primitive::<Float64Type>().values())),
        DataType::Boolean => {
            Ok(Column::Cells(array.as_boolean().iter().map(|truth| truth.map_or(Cell::Empty, |truth| column.of_truth(truth))).collect()))
        }
        DataType::Utf8 => Ok(texts(column, array)),
        data_type if is_text(data_type) => Ok(texts(column, &cast(array, &DataType::Utf8)?)),
        // Their digits as text, which is rounded once.
        data_type if data_type.is_decimal() => Ok(texts(column, &cast(array, &DataType::Utf8)?)),
        DataType::Dictionary(_, values) if values.is_decimal() => Ok(texts(column, &cast(&cast(array, values)?, &DataType::Utf8)?)),
        _ => {
            let numbers = cast(array, &DataType::Float64)?;
            let cell = |number: Option<f64>| number.map_or(Cell::Empty, |number| column.of_number(number));
            Ok(Column::Cells(numbers.as_primitive::<Float64Type>().iter().map(cell).collect()))
        }
    }
}

/// Returns texts as the numbers that they are; null where one is not.
///
/// # Errors
///
/// If the array cannot be converted to text.
pub fn numbers(texts: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let texts = cast(texts, &DataType::Utf8)?;
    let numbers = texts.as_string::<i32>().iter().map(|text| text?.trim().parse::<f64>().ok().filter(|number| number.is_finite()));
    Ok(Arc::new(Float64Array::from_iter(numbers)))
}

fn texts(column: &InputColumn, array: &ArrayRef) -> Column<'static> {
    Column::Cells(array.as_string::<i32>().iter().map(|text| text.map_or(Cell::Empty, |text| column.of_text(text))).collect())
}
