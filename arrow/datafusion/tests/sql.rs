//! SQL over a file of Parquet: a condition on ΔV, groups, and queries that are wrong.

use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, AsArray, Float64Array, RecordBatch, StringArray};
use datafusion::arrow::datatypes::{Float64Type, Int64Type};
use datafusion::dataframe::DataFrameWriteOptions;
use datafusion::prelude::{ParquetReadOptions, SessionContext};
use planar_impact_app::{Case, Source};

const CASE: &str = include_str!("../../../cli/examples/position-a.toml");

fn case() -> Case {
    Case::parse(Source::new("position-a.toml", CASE)).expect("the example")
}

/// Speeds of vehicle 1 at two sites, every tenth of them away from the other vehicle.
fn speeds() -> Vec<(f64, &'static str)> {
    (0..20_000).map(|i| (f64::from(i % 37) * if i % 10 == 9 { -1.0 } else { 1.0 } + 0.5, ["north", "south"][i as usize % 2])).collect()
}

async fn session() -> (SessionContext, std::path::PathBuf) {
    let context = SessionContext::new();
    planar_impact_datafusion::register(&context, Some(case()));
    let folder = std::env::temp_dir().join(format!("planar-impact-datafusion-{}-{:?}", std::process::id(), std::thread::current().id()));
    let (speeds, sites): (Vec<f64>, Vec<&str>) = speeds().into_iter().unzip();
    let columns: [(&str, ArrayRef); 2] = [("speed", Arc::new(Float64Array::from(speeds))), ("site", Arc::new(StringArray::from(sites)))];
    let table = RecordBatch::try_from_iter(columns).expect("columns of one length");
    let path = folder.join("crashes.parquet");
    let text = path.to_str().expect("a plain path").to_owned();
    context.read_batch(table).expect("a table").write_parquet(&text, DataFrameWriteOptions::new(), None).await.expect("it is written");
    context.register_parquet("crashes", &text, ParquetReadOptions::default()).await.expect("it is read");
    (context, folder)
}

/// ΔV of vehicle 1 in each row, by the library.
fn delta_vs() -> Vec<Option<(f64, &'static str)>> {
    let parameter = planar_impact_app::case::Parameter::named("vehicle.1.speed").expect("a parameter");
    let alone = |speed: f64| case().with(&[(parameter, speed)]).impact().ok().map(|impact| impact.one.delta_v_magnitude());
    let mut known = std::collections::HashMap::new();
    speeds()
        .into_iter()
        .map(|(speed, site)| known.entry(speed.to_bits()).or_insert_with(|| alone(speed)).map(|delta_v| (delta_v, site)))
        .collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn conditions_and_groups() {
    let (context, folder) = session().await;
    let delta_v = "planar_impact('vehicle.1.delta_v_magnitude', named_struct('vehicle.1.speed', speed))";
    let sql = format!(
        "SELECT site, count(*) AS n, avg(dv) AS mean FROM (SELECT site, {delta_v} AS dv FROM crashes) WHERE dv > 8 GROUP BY site ORDER BY site"
    );
    let found = context.sql(&sql).await.expect("a query").collect().await.expect("an answer");
    let mut groups = Vec::new();
    for batch in &found {
        let counts = batch.column(1).as_primitive::<Int64Type>().values().to_vec();
        groups.extend(counts.into_iter().zip(batch.column(2).as_primitive::<Float64Type>().values().to_vec()));
    }
    let all = delta_vs();
    for (site, (count, mean)) in ["north", "south"].into_iter().zip(&groups) {
        let of_site: Vec<f64> =
            all.iter().flatten().filter(|(delta_v, of)| *of == site && *delta_v > 8.0).map(|(delta_v, _)| *delta_v).collect();
        assert_eq!(*count, of_site.len() as i64, "{site}");
        assert!((mean - of_site.iter().sum::<f64>() / of_site.len() as f64).abs() < 1e-9, "{site}");
    }
    assert!(groups.len() == 2 && groups.iter().all(|(count, _)| *count > 1000), "{groups:?}");

    let refusal = "planar_impact('refusal', named_struct('vehicle.1.speed', speed))";
    let sql = format!("SELECT count(*) FROM crashes WHERE {refusal} = 'separating' AND {delta_v} IS NULL");
    let found = context.sql(&sql).await.expect("a query").collect().await.expect("an answer");
    let refused = all.iter().filter(|row| row.is_none()).count();
    assert!(refused > 500);
    assert_eq!(found[0].column(0).as_primitive::<Int64Type>().value(0), refused as i64);
    std::fs::remove_dir_all(folder).expect("it is there");
}

#[tokio::test]
async fn a_wrong_query_is_refused_before_it_runs() {
    let (context, folder) = session().await;
    let queries = [
        ("planar_impact('energy.los', named_struct('vehicle.1.speed', speed))", "unknown output"),
        ("planar_impact('energy.loss', named_struct('vehicle.1.sped', speed))", "did you mean `vehicle.1.speed`"),
        ("planar_impact('energy.loss', named_struct('vehicle.1.speed [kg]', speed))", "a speed is expected"),
        ("planar_impact(site, named_struct('vehicle.1.speed', speed))", "the name of an output"),
        ("planar_impact('energy.loss', speed)", "is a struct of inputs"),
    ];
    for (call, message) in queries {
        let error = match context.sql(&format!("SELECT {call} FROM crashes")).await {
            Err(error) => error.to_string(),
            Ok(query) => query.create_physical_plan().await.expect_err(call).to_string(),
        };
        assert!(error.contains(message), "{call}: {error}");
    }
    std::fs::remove_dir_all(folder).expect("it is there");
}
