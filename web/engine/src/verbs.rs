//! The verbs that a page asks for: each answer as JSON, HTML, SVG and CSV.

use planar_impact_app::gradient::Selection;
use planar_impact_app::json::{self, Layout};
use planar_impact_app::{
    Answer, Case, Issue, Issues, Units, crash3, crush, formula, gradient, reconstruct, scene, slide, solve, sweep, uncertainty,
};
use planar_impact_report::block::Block;
use planar_impact_report::page::{self, Facts};
use planar_impact_report::{chart, document, html};
use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

use crate::control::Reporter;
use crate::input::{self, Input};
use crate::reply::Reply;

/// Most rows of a table on a page.
const MOST_ROWS: usize = 2000;
/// Most points of a sweep, whose files the page holds in memory.
const MOST_POINTS: sweep::Shown = sweep::Shown { most: 100_000, by: "Vary", help: "take a larger step" };

/// Options of every verb; each reads its own.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Options {
    of: Vec<String>,
    wrt: Vec<String>,
    second: bool,
    vary: Vec<String>,
    posterior: bool,
    probabilities: Vec<String>,
    samples: Option<u64>,
    methods: Vec<String>,
    output: String,
}

/// Answers a verb about a case. `case` and `options` are JSON.
#[wasm_bindgen]
pub fn answer(verb: &str, case: &str, options: &str) -> Reply {
    let request = input::read::<Input>(case).and_then(|case| Ok((case, input::read::<Options>(options)?)));
    let (input, options) = match request {
        Ok(request) => request,
        Err(issues) => return Reply::refusal(&issues, Units::Si),
    };
    let case = match input.case() {
        Ok(case) => case,
        Err(issues) => return Reply::refusal(&issues, input.units_or(Units::Si)),
    };
    let units = input.units(&case);
    run(verb, &case, units, &options).unwrap_or_else(|issues| Reply::refusal(&issues, units))
}

fn run(verb: &str, case: &Case, units: Units, options: &Options) -> Result<Reply, Issues> {
    match verb {
        "solve" => {
            let answer = solve::solve(case, &(), &Reporter)?;
            written(&answer, units, Layout::Pretty, document::figures_of_solution(&answer, units)?)
        }
        "gradient" => {
            // The JSON has everything, the page what is of most interest, as on the command line.
            let of = |all: Selection| gradient::Options {
                of: named(&options.of, all.clone()),
                wrt: named(&options.wrt, all),
                second: options.second,
            };
            let full = gradient::gradient(case, &of(Selection::All), &Reporter)?;
            let shown = gradient::gradient(case, &of(Selection::Principal), &Reporter)?;
            Ok(Reply { json: json::text(&full, Layout::Pretty)?, ..written(&shown, units, Layout::Pretty, Vec::new())? })
        }
        "sweep" => {
            let asked = sweep::Options { vary: options.vary.clone(), of: options.of.clone(), shown: Some(MOST_POINTS) };
            let answer = sweep::sweep(case, &asked, &Reporter)?;
            let svg = chart::sweep(&answer, units)?;
            let csv = csv(page::sweep_csv::records(&answer, units))?;
            let rows = answer.refused.len();
            let reply = if rows > MOST_ROWS {
                let text = format!("The table has {rows} rows, and more than {MOST_ROWS} are not shown: export it as CSV or JSON.");
                let html = html::fragment(&[Block::paragraph(&text), figure("Chart", svg.clone())]);
                Reply { json: json::text(&answer, Layout::Compact)?, html, ..Reply::default() }
            } else {
                written(&answer, units, Layout::Compact, vec![figure("Chart", svg.clone())])?
            };
            Ok(Reply { csv, svg, ..reply })
        }
        "crush" => written(&crush::crush(case, &(), &Reporter)?, units, Layout::Pretty, Vec::new()),
        "crash3" => written(&crash3::crash3(case, &(), &Reporter)?, units, Layout::Pretty, Vec::new()),
        "slide" => {
            let answer = slide::slide(case, &(), &Reporter)?;
            let csv = csv(page::slide::records(&answer, units).into_iter())?;
            Ok(Reply { csv, ..written(&answer, units, Layout::Pretty, Vec::new())? })
        }
        "draw" => {
            let answer = scene::draw(case, &(), &Reporter)?;
            let svg = planar_impact_report::scene::scene(&answer, units);
            Ok(Reply {
                json: json::text(&answer, Layout::Pretty)?,
                html: html::fragment(&[figure("Scene", svg.clone())]),
                svg,
                ..Reply::default()
            })
        }
        "reconstruct" => {
            let asked = reconstruct::Options {
                posterior: options.posterior,
                probabilities: options.probabilities.clone(),
                ..reconstruct::Options::default()
            };
            let answer = reconstruct::reconstruct(case, &asked, &Reporter)?;
            written(&answer, units, Layout::Pretty, document::figures_of_reconstruction(&answer, units)?)
        }
        "uncertainty" => {
            let asked = uncertainty::Options {
                of: options.of.clone(),
                methods: options.methods.iter().map(|name| method(name)).collect::<Result<_, _>>()?,
                samples: options.samples.unwrap_or(uncertainty::Options::default().samples),
                probabilities: options.probabilities.clone(),
                ..uncertainty::Options::default()
            };
            let answer = uncertainty::uncertainty(case, &asked, &Reporter)?;
            let svg = chart::uncertainty(&answer, units)?;
            let csv = csv(page::uncertainty_csv::records(&answer, units).into_iter())?;
            Ok(Reply {
                csv,
                svg: svg.clone(),
                ..written(&answer, units, Layout::Pretty, vec![figure("The outputs by every method", svg)])?
            })
        }
        "formula" => {
            let issue = |option: &'static str| move |message: String| Issues::of_call(vec![Issue::of_call(option, message, None)]);
            let wrt = options.wrt.first().map(|name| formula::input(name).map_err(issue("wrt"))).transpose()?;
            let output = formula::output(&options.output).map_err(issue("output"))?;
            let answer = formula::formula(Some(case), &formula::Options { output, wrt, kind: formula::Kind::default() }, &Reporter)?;
            let blocks = [Block::Formula { latex: answer.formula.latex(), text: answer.subject.clone() }];
            let blocks: Vec<Block> = blocks.into_iter().chain(page::formula::page(&answer, units)).collect();
            Ok(Reply { json: json::text(&answer, Layout::Pretty)?, html: html::fragment(&blocks), ..Reply::default() })
        }
        other => Err(unknown("verb", other)),
    }
}

fn named(names: &[String], all: Selection) -> Selection {
    if names.is_empty() { all } else { Selection::Named(names.to_vec()) }
}

fn method(name: &str) -> Result<uncertainty::Method, Issues> {
    Ok(match name {
        "linear" => uncertainty::Method::Linear,
        "second-order" => uncertainty::Method::SecondOrder,
        "monte-carlo" => uncertainty::Method::MonteCarlo,
        "sobol" => uncertainty::Method::Sobol,
        "shapley" => uncertainty::Method::Shapley,
        "bounds" => uncertainty::Method::Bounds,
        other => return Err(unknown("method", other)),
    })
}

fn unknown(what: &str, word: &str) -> Issues {
    let word: String = word.chars().take(60).collect();
    Issues::of_call(vec![Issue::of_call(what, format!("unknown value {word:?}"), None)])
}

pub(crate) fn figure(title: &str, svg: String) -> Block {
    Block::Figure { title: title.to_owned(), svg }
}

/// Writes an answer: its tables, then its figures.
fn written<T: Facts + Serialize>(answer: &Answer<T>, units: Units, layout: Layout, figures: Vec<Block>) -> Result<Reply, Issues> {
    let blocks: Vec<Block> = page::page(answer, units).into_iter().chain(figures).collect();
    Ok(Reply { json: json::text(answer, layout)?, html: html::fragment(&blocks), ..Reply::default() })
}

fn csv(records: impl Iterator<Item = Vec<String>>) -> Result<String, Issues> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer.write_record(record).map_err(Issues::defect)?;
    }
    String::from_utf8(writer.into_inner().map_err(Issues::defect)?).map_err(Issues::defect)
}
