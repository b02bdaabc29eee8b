//! The traces of a recording: a panel for each kind of channel.

use planar_impact_app::issue::Issues;
use planar_impact_app::plain_text::shorten;
use planar_impact_app::record::{ChannelQuantity, Records, Trace};
use planar_impact_app::units::Measure;
use planar_impact_app::{Answer, Units};

use super::canvas::{self, Area, Axes, Drawn, GRAY, Stroke, WIDTH, span, with_unit};
use super::lines::{LEGEND, LINES, PANEL, draw_run, row_of, sample, sample_of, thinned};

/// How values before the filter are drawn, beneath the filtered ones.
const UNFILTERED: Stroke = Stroke::solid(GRAY, 1);

/// The traces of one panel.
struct Panel<'a> {
    traces: Vec<(String, &'a Trace)>,
    units: Units,
}

/// Draws the traces of recordings: forces by bank, accelerations, distances, velocity changes and speeds before the impact.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn record(answer: &Answer<Records>, units: Units) -> Result<String, Issues> {
    let mut panels: Vec<Panel<'_>> = Vec::new();
    for record in &answer.records {
        for trace in &record.traces {
            let name = if answer.records.len() > 1 { format!("{}: {}", record.file, trace.name) } else { trace.name.clone() };
            match panels.iter_mut().find(|panel| noun(panel.traces[0].1.quantity) == noun(trace.quantity) && panel.traces.len() < LINES) {
                Some(panel) => panel.traces.push((name, trace)),
                None => panels.push(Panel { traces: vec![(name, trace)], units }),
            }
        }
    }
    let title = match &answer.records[..] {
        [one] if answer.title.is_empty() => &one.file,
        _ => &answer.title,
    };
    canvas::page(title, &described(&panels), PANEL * panels.len() as u32, |body| {
        let left = panels.iter().map(|panel| Axes::room(&panel.y())).max().unwrap_or(0);
        for (panel, area) in panels.iter().zip(body.split_evenly((panels.len(), 1))) {
            panel.draw(&area, left)?;
        }
        Ok(())
    })
}

/// Says in words what is drawn.
fn described(panels: &[Panel<'_>]) -> String {
    let names = panels.iter().flat_map(|panel| &panel.traces).map(|(name, _)| shorten(name, 40));
    format!("Traces over time: {}.", names.collect::<Vec<_>>().join(", "))
}

impl Panel<'_> {
    /// Returns the measure of its values; speeds are in the unit of the road.
    fn measure(&self) -> Measure {
        let measure = self.traces[0].1.quantity.measure();
        self.units.on_the_road(measure).unwrap_or(measure)
    }

    fn values(&self) -> impl Iterator<Item = f64> + Clone + '_ {
        let conversion = self.units.conversion(self.measure());
        let all = self.traces.iter().flat_map(|(_, trace)| trace.values.iter().chain(trace.unfiltered.iter().flatten()));
        all.map(move |value| conversion.of_si(*value))
    }

    fn y(&self) -> std::ops::Range<f64> {
        span(self.values().chain([0.0]), 0.06)
    }

    fn draw(&self, area: &Area<'_>, left: u32) -> Drawn {
        let quantity = self.traces[0].1.quantity;
        let conversion = self.units.conversion(self.measure());
        let (plot, legend) = area.split_horizontally(WIDTH - LEGEND);
        let axes = Axes {
            x: span(self.traces.iter().flat_map(|(_, trace)| trace.times.iter().copied()), 0.0),
            y: self.y(),
            x_name: "time [s]",
            y_name: &with_unit(noun(quantity), self.units.unit(self.measure())),
            left,
        };
        let mut chart = axes.draw(&plot)?;
        let points = |trace: &Trace, values: &[f64]| {
            thinned(trace.times.iter().zip(values).map(|(time, value)| (*time, conversion.of_si(*value))).collect())
        };
        let unfiltered: Vec<_> = self.traces.iter().filter_map(|(_, trace)| Some(points(trace, trace.unfiltered.as_ref()?))).collect();
        for line in &unfiltered {
            UNFILTERED.line(&mut chart, line.iter().copied())?;
        }
        let mut rows = 0;
        for (i, (name, trace)) in self.traces.iter().enumerate() {
            draw_run(&mut chart, &points(trace, &trace.values), i)?;
            let filter = trace.filter.map_or_else(String::new, |class| format!(" CFC {class}"));
            rows += sample(&legend, i, rows, &(shorten(name, 40) + &filter))?;
        }
        if !unfiltered.is_empty() {
            sample_of(&legend, UNFILTERED, row_of(self.traces.len(), rows), "before the filter")?;
        }
        Ok(())
    }
}

/// Returns the name of an axis.
fn noun(quantity: ChannelQuantity) -> &'static str {
    match quantity {
        ChannelQuantity::NormalForce | ChannelQuantity::TangentialForce => "force",
        ChannelQuantity::Acceleration => "acceleration",
        ChannelQuantity::Distance => "distance",
        ChannelQuantity::Speed => "speed",
        _ => "delta-V",
    }
}
