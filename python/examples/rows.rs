//! Solves columns of numbers without Python, for `benches/speed.py` to compare with: names on the command line, numbers column by column on
//! the standard input, the shortest time of a few runs in seconds on the standard output.

use std::error::Error;
use std::io::Read;
use std::sync::Mutex;
use std::time::Instant;

use planar_impact_app::batch::{Header, Options, Plan, Table};

/// Rows that one thread solves before it takes more, as in the extension.
const ROWS: usize = 1 << 14;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let threads: usize = arguments.next().ok_or("threads")?.parse()?;
    let runs: usize = arguments.next().ok_or("runs")?.parse()?;
    let headers: Vec<Header> = arguments.map(|name| Header::read(&name)).collect();
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes)?;
    let (numbers, _) = bytes.as_chunks::<8>();
    let numbers: Vec<f64> = numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let rows = numbers.len() / headers.len();
    let columns: Vec<&[f64]> = numbers.chunks(rows).collect();
    let plan = Plan::of(&headers, None, &Options::default()).map_err(|issues| issues.to_string())?;
    let mut shortest = f64::INFINITY;
    for _ in 0..runs {
        let started = Instant::now();
        let mut outputs: Vec<Vec<f64>> = plan.outputs().iter().map(|_| vec![0.0; rows]).collect();
        let mut parts: Vec<Vec<&mut [f64]>> = (0..rows).step_by(ROWS).map(|_| Vec::new()).collect();
        outputs.iter_mut().for_each(|column| parts.iter_mut().zip(column.chunks_mut(ROWS)).for_each(|(part, chunk)| part.push(chunk)));
        let queue = Mutex::new(parts.into_iter().enumerate());
        let work = || {
            while let Some((place, part)) = queue.lock().ok().and_then(|mut queue| queue.next()) {
                let (first, rows) = (place * ROWS, ROWS.min(rows - place * ROWS));
                let column = |input: &planar_impact_app::batch::InputColumn| input.of_numbers(&columns[input.place][first..first + rows]);
                let answer = plan.solve(&Table { rows, columns: plan.inputs().iter().map(column).collect(), unreadable: Vec::new() });
                part.into_iter().zip(&answer.outputs).for_each(|(to, from)| to.copy_from_slice(from));
            }
        };
        std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
        shortest = shortest.min(started.elapsed().as_secs_f64());
    }
    println!("{shortest}");
    Ok(())
}
