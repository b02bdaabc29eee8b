//! Planar impacts in SQL: the function `planar_impact` for [DataFusion](https://datafusion.apache.org), and so for what is built on it.
//!
//! `planar_impact(OUTPUT, STRUCT)` solves the collision that a struct describes and returns one of its outputs, null where it is refused. The fields of the
//! struct are named as the columns of `planar-impact batch`, with their unit in brackets; what it does not have is taken from a case file.
//! `planar_impact('refusal', STRUCT)` is the reason why there is no output, null where there is one. The engine spreads the rows over its threads, and reads
//! Parquet by itself:
//!
//! ```
//! use datafusion::prelude::SessionContext;
//! # #[tokio::main]
//! # async fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let context = SessionContext::new();
//! let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 15\nimpact_center = [2, 0]\n[[vehicle]]\nbarrier = true\n\
//!             [contact]\ncrush_plane = 0\nrestitution = 0.1\n";
//! let case = planar_impact_app::Case::parse(planar_impact_app::Source::new("barrier.toml", case))?;
//! planar_impact_datafusion::register(&context, Some(case));
//! let rows = context.sql(
//!     "SELECT v, planar_impact('vehicle.1.delta_v_magnitude', named_struct('vehicle.1.speed [km/h]', v)) AS delta_v FROM (VALUES (18.0), (36.0)) AS t(v)",
//! );
//! assert_eq!(rows.await?.count().await?, 2);
//! # Ok(())
//! # }
//! ```

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use datafusion::arrow::array::{AsArray, RecordBatch};
use datafusion::arrow::datatypes::{DataType, Field, FieldRef, Schema};
use datafusion::common::{Result, ScalarValue, exec_err, plan_err};
use datafusion::error::DataFusionError;
use datafusion::logical_expr::{ColumnarValue, ReturnFieldArgs, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature, Volatility};
use datafusion::prelude::SessionContext;
use planar_impact_app::{Case, Issues};
use planar_impact_arrow::{Options, Plan};

/// The output that is the reason for having none.
const REFUSAL: &str = "refusal";

/// Makes `planar_impact` known to a session, with the case that supplies what a struct does not have.
pub fn register(context: &SessionContext, base: Option<Case>) {
    context.register_udf(function(base));
}

/// Returns the function itself, with the case that supplies what a struct does not have.
pub fn function(base: Option<Case>) -> ScalarUDF {
    ScalarUDF::from(PlanarImpact { signature: Signature::any(2, Volatility::Immutable), base: base.map(Arc::new) })
}

struct PlanarImpact {
    signature: Signature,
    base: Option<Arc<Case>>,
}

impl std::fmt::Debug for PlanarImpact {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PlanarImpact").field("base", &self.base.as_ref().map(|case| &case.title)).finish_non_exhaustive()
    }
}

impl PlanarImpact {
    fn case(&self) -> *const Case {
        self.base.as_ref().map_or(std::ptr::null(), Arc::as_ptr)
    }

    /// Plans one output of the structs with these fields.
    fn plan(&self, of: &str, schema: &Arc<Schema>) -> std::result::Result<Plan, Issues> {
        // Every plan answers with the refusal; an output is computed beside it, so take the one that is always there.
        let of = if of == REFUSAL { "energy.loss" } else { of };
        Plan::of(schema, self.base.as_deref(), &Options { of: vec![of.to_owned()], ..Options::default() })
    }
}

/// Two functions are equal if they have the same case.
impl PartialEq for PlanarImpact {
    fn eq(&self, other: &Self) -> bool {
        self.case() == other.case()
    }
}

impl Eq for PlanarImpact {}

impl Hash for PlanarImpact {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.case().hash(state);
    }
}

impl ScalarUDFImpl for PlanarImpact {
    fn name(&self) -> &str {
        "planar_impact"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        plan_err!("the type of planar_impact depends on the name of the output")
    }

    fn return_field_from_args(&self, args: ReturnFieldArgs<'_>) -> Result<FieldRef> {
        let of = name(args.scalar_arguments.first().copied().flatten())?;
        let DataType::Struct(fields) = args.arg_fields[1].data_type() else {
            return plan_err!("the second argument of planar_impact is a struct of inputs, as named_struct('vehicle.1.speed [mph]', v)");
        };
        // Every mistake in a name is one of the query, and found before it runs.
        self.plan(of, &Arc::new(Schema::new(fields.clone()))).map_err(wrong)?;
        let data_type = if of == REFUSAL { DataType::Utf8 } else { DataType::Float64 };
        Ok(Arc::new(Field::new(self.name(), data_type, true)))
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let of = match &args.args[0] {
            ColumnarValue::Scalar(of) => name(Some(of))?.to_owned(),
            ColumnarValue::Array(_) => return exec_err!("the name of an output is a constant"),
        };
        let structs = args.args[1].to_array(args.number_rows)?;
        let Some(structs) = structs.as_struct_opt() else { return exec_err!("the second argument of planar_impact is a struct of inputs") };
        let table = RecordBatch::try_new(Arc::new(Schema::new(structs.fields().clone())), structs.columns().to_vec())?;
        let answer = self.plan(&of, table.schema_ref()).map_err(wrong)?.solve(&table)?;
        // The output stands between the columns of the table and the refusal.
        let place = answer.num_columns() - if of == REFUSAL { 1 } else { 2 };
        Ok(ColumnarValue::Array(answer.column(place).clone()))
    }
}

fn name(of: Option<&ScalarValue>) -> Result<&str> {
    match of.and_then(|of| of.try_as_str().flatten()) {
        Some(of) => Ok(of),
        None => plan_err!("the first argument of planar_impact is the name of an output, such as 'energy.loss', or 'refusal'"),
    }
}

fn wrong(issues: Issues) -> DataFusionError {
    DataFusionError::Plan(format!("planar_impact: {issues}"))
}
