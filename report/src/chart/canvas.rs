//! The common parts of all charts: the page, the axes and the notation of their numbers.

use std::ops::Range as Span;

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::{
    BLACK, Cartesian2d, ChartBuilder, Color, DashedLineSeries, DrawingArea, FontTransform, IntoDrawingArea, IntoFont, IntoTextStyle,
    LineSeries, PathElement, RGBColor, Rectangle, SVGBackend, ShapeStyle, WHITE,
};

use planar_impact_app::issue::Issues;
use planar_impact_app::plain_text::{clean, shorten};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use quick_xml::escape::escape;

use super::joined::joined;

/// An area to draw on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A chart with linear axes.
pub type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Drawing units per pixel: coordinates are whole numbers, so a fine unit makes lines smooth.
const FINE: u32 = 8;
/// Converts pixels to drawing units.
pub const fn px(pixels: u32) -> u32 {
    FINE * pixels
}

pub const WIDTH: u32 = px(900);
const TITLE: u32 = px(40);
const LONGEST_TITLE: usize = 80;
const FONT: &str = "sans-serif";
pub const GRID: RGBColor = RGBColor(222, 222, 222);

// Colors that remain distinct in color blindness (Okabe and Ito 2008), darkened where text has them.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub const GREEN: RGBColor = RGBColor(0, 130, 100);
pub const DARK: RGBColor = RGBColor(40, 40, 40);
pub const GRAY: RGBColor = RGBColor(90, 90, 90);

/// The result of drawing.
pub type Drawn<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// Draws a page with a title and, below it, a drawing with a given height. A screen reader reads the title and the description in place of the drawing.
///
/// # Errors
///
/// Fails only because of a defect, because drawing into memory cannot fail.
pub fn page(title: &str, description: &str, height: u32, draw: impl FnOnce(&Area<'_>) -> Drawn) -> Result<String, Issues> {
    let (mut text, height) = (String::new(), TITLE + height);
    let title = shorten(title, LONGEST_TITLE);
    let title = title.trim();
    let on_page = |text: &mut String| -> Drawn {
        let page = SVGBackend::with_string(text, (WIDTH, height)).into_drawing_area();
        page.fill(&WHITE)?;
        let (head, body) = page.split_vertically(TITLE);
        if !title.is_empty() {
            write(&head, title, 21, (16, 12))?;
        }
        draw(&body)?;
        Ok(page.present()?)
    };
    on_page(&mut text).map_err(Issues::defect)?;
    // The view box keeps the drawing units; the size is in pixels.
    let size = |fine: u32| format!("<svg width=\"{}\" height=\"{}\"", WIDTH / fine, height / fine);
    let Some((root, drawing)) = text.strip_prefix(&size(1)).and_then(|rest| rest.split_once('>')) else {
        return Err(Issues::defect("the chart has no size"));
    };
    let titled = |element: &str, words: &str| format!("<{element}>{}</{element}>", escape(printable(words)));
    // Without a title the description is its name.
    let (title, description) = (titled("title", if title.is_empty() { description } else { title }), titled("desc", description));
    Ok(format!("{}{root} role=\"img\">\n{title}\n{description}{}", size(FINE), joined(drawing)))
}

/// Replaces the characters that XML does not allow, and those that a document interprets.
fn printable(text: &str) -> String {
    clean(text).replace(['\u{fffe}', '\u{ffff}'], " ")
}

/// Axes with names and units.
pub struct Axes<'a> {
    pub x: Span<f64>,
    pub y: Span<f64>,
    pub x_name: &'a str,
    /// Empty for rows, which have words of their own in place of numbers.
    pub y_name: &'a str,
    /// Width available for the numbers and the name of y, in pixels.
    pub left: u32,
}

impl Axes<'_> {
    /// Returns the width needed for the name and the numbers of the y axis, in pixels. Digits are about half as wide as they are high.
    pub fn room(y: &Span<f64>) -> u32 {
        let digits = Digits::of(y);
        let longest = [y.start, y.end].map(|value| digits.write(value).chars().count()).into_iter().max().unwrap_or(0);
        32 + 9 * longest as u32
    }

    /// Returns how many numbers fit below the axis without touching each other.
    fn x_count(&self, digits: &Digits, area: &Area<'_>) -> usize {
        let longest = [self.x.start, self.x.end].map(|value| digits.write(value).chars().count()).into_iter().max().unwrap_or(1);
        let room = area.dim_in_pixel().0 / px(1) - self.left;
        (room as usize / (10 * longest + 14)).clamp(2, 11)
    }

    /// Draws the axes and returns the chart to draw on.
    pub fn draw<'a, 'b>(&self, area: &'a Area<'b>) -> Drawn<Chart<'a, 'b>> {
        let (x_digits, y_digits) = (Digits::of(&self.x), Digits::of(&self.y));
        let mut chart = ChartBuilder::on(area)
            .margin_top(px(12))
            .margin_right(px(24))
            .margin_left(px(12))
            .margin_bottom(px(8))
            .x_label_area_size(px(48))
            .y_label_area_size(px(self.left))
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        let mut mesh = chart.configure_mesh();
        if self.y_name.is_empty() {
            mesh.disable_y_mesh();
        }
        mesh.light_line_style(WHITE.mix(0.0))
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(BLACK.stroke_width(FINE))
            .set_all_tick_mark_size(px(5))
            .label_style((FONT, px(16)).into_text_style(area))
            .axis_desc_style((FONT, px(17)).into_text_style(area))
            .x_desc(printable(self.x_name))
            .y_desc(printable(self.y_name))
            .x_labels(self.x_count(&x_digits, area))
            .y_labels(if self.y_name.is_empty() { 0 } else { 8 })
            .x_label_formatter(&|value| x_digits.write(*value))
            .y_label_formatter(&|value| y_digits.write(*value))
            .draw()?;
        Ok(chart)
    }
}

/// Notation of the numbers of an axis, with as many decimals as distinguish its ticks.
pub struct Digits {
    decimals: usize,
    power: bool,
}

impl Digits {
    pub fn of(span: &Span<f64>) -> Digits {
        let (length, most) = (span.end - span.start, span.start.abs().max(span.end.abs()));
        let power = !(1e-4..1e7).contains(&most);
        // A tick is about a tenth of the axis; the margin keeps rounding from adding a digit.
        let unit = if power { most } else { 1.0 };
        let decimals = (-libm::log10(1.001 * length / unit / 10.0).floor()).clamp(0.0, 15.0) as usize;
        Digits { decimals, power }
    }

    pub fn write(&self, value: f64) -> String {
        let decimals = self.decimals;
        if self.power && value != 0.0 {
            return format!("{value:.decimals$e}");
        }
        let text = format!("{value:.decimals$}");
        match text.strip_prefix('-') {
            Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
            _ => text,
        }
    }
}

/// Returns a span around values with some margin; around a single value, or values that differ only by rounding, a
/// span proportional to their size.
pub fn span(values: impl Iterator<Item = f64> + Clone, room: f64) -> Span<f64> {
    let finite = values.filter(|value| value.is_finite());
    let (low, high) = (finite.clone().fold(f64::INFINITY, f64::min), finite.fold(f64::NEG_INFINITY, f64::max));
    if low > high {
        return 0.0..1.0;
    }
    let size = low.abs().max(high.abs());
    let length = high - low;
    if length <= 1e-11 * size || length == 0.0 {
        let half = if size == 0.0 { 1.0 } else { 0.1 * size };
        return low - half..high + half;
    }
    low - room * length..high + room * length
}

/// Joins a name and its unit.
pub fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// Writes a text with its upper left corner at a position in pixels.
pub fn write(area: &Area<'_>, text: &str, size: u32, at: (i32, i32)) -> Drawn {
    Writing { size, ..Writing::default() }.write(area, text, at)
}

/// How a text is written, where its position is not that of its upper left corner, or its color not black.
pub struct Writing {
    pub size: u32,
    pub color: RGBColor,
    pub across: HPos,
    pub down: VPos,
    /// `true` for a text that runs upwards.
    pub is_upright: bool,
}

impl Default for Writing {
    fn default() -> Writing {
        Writing { size: 14, color: BLACK, across: HPos::Left, down: VPos::Top, is_upright: false }
    }
}

impl Writing {
    /// Returns that of a text which ends at its position.
    pub fn ending() -> Writing {
        Writing { across: HPos::Right, ..Writing::default() }
    }

    /// Returns that of a text around its position.
    pub fn centered() -> Writing {
        Writing { across: HPos::Center, ..Writing::default() }
    }

    /// Writes a text at a position in pixels.
    pub fn write(self, area: &Area<'_>, text: &str, at: (i32, i32)) -> Drawn {
        let fine = FINE as i32;
        let turn = if self.is_upright { FontTransform::Rotate270 } else { FontTransform::None };
        let style = (FONT, px(self.size)).into_font().transform(turn).color(&self.color).pos(Pos::new(self.across, self.down));
        area.draw_text(&printable(text), &style, (fine * at.0, fine * at.1))?;
        Ok(())
    }
}

/// Draws a rectangle between two corners in pixels.
pub fn rectangle(area: &Area<'_>, from: (i32, i32), to: (i32, i32), style: ShapeStyle) -> Drawn {
    let fine = FINE as i32;
    area.draw(&Rectangle::new([(fine * from.0, fine * from.1), (fine * to.0, fine * to.1)], style))?;
    Ok(())
}

/// Draws the outline of a rectangle between two corners in pixels.
pub fn outline(area: &Area<'_>, from: (i32, i32), to: (i32, i32), color: RGBColor) -> Drawn {
    let corners = [from, (to.0, from.1), to, (from.0, to.1), from].map(|(x, y)| (FINE as i32 * x, FINE as i32 * y));
    area.draw(&PathElement::new(corners, color.stroke_width(FINE)))?;
    Ok(())
}

/// Draws a line between two points in pixels.
pub fn segment(area: &Area<'_>, from: (i32, i32), to: (i32, i32), style: ShapeStyle) -> Drawn {
    let fine = FINE as i32;
    area.draw(&PathElement::new([(fine * from.0, fine * from.1), (fine * to.0, fine * to.1)], style))?;
    Ok(())
}

/// Draws diagonals within a rectangle in pixels, so that it differs from others without its color.
pub fn hatch(area: &Area<'_>, from: (i32, i32), to: (i32, i32), style: ShapeStyle) -> Drawn {
    /// Distance of the lines, across.
    const APART: usize = 6;
    let ((left, top), (right, bottom)) = ((from.0.min(to.0), from.1.min(to.1)), (from.0.max(to.0), from.1.max(to.1)));
    let high = bottom - top;
    for start in ((left - high)..right).step_by(APART) {
        // From the lower edge upwards to the right, cut at the sides.
        let (cut, end) = ((left - start).max(0), (right - start).min(high));
        if cut < end {
            segment(area, (start + cut, bottom - cut), (start + end, bottom - end), style)?;
        }
    }
    Ok(())
}

/// A style of lines: a color with the lengths of dash and gap in pixels. No gap is a solid line.
#[derive(Clone, Copy)]
pub struct Stroke {
    pub color: RGBColor,
    pub width: u32,
    pub dash: i32,
    pub gap: i32,
}

impl Stroke {
    /// Returns a solid line.
    pub const fn solid(color: RGBColor, width: u32) -> Stroke {
        Stroke { color, width, dash: 1, gap: 0 }
    }

    /// Returns a broken line.
    pub const fn dashed(color: RGBColor, width: u32, dash: i32, gap: i32) -> Stroke {
        Stroke { color, width, dash, gap }
    }

    fn style(self) -> ShapeStyle {
        self.color.stroke_width(px(self.width))
    }

    /// Draws a line through points of a chart.
    pub fn line(self, chart: &mut Chart<'_, '_>, points: impl IntoIterator<Item = (f64, f64)>) -> Drawn {
        let (points, fine) = (points.into_iter().collect::<Vec<_>>(), FINE as i32);
        if self.gap == 0 {
            chart.draw_series(LineSeries::new(points, self.style()))?;
        } else {
            chart.draw_series(DashedLineSeries::new(points, fine * self.dash, fine * self.gap, self.style()))?;
        }
        Ok(())
    }

    /// Draws a sample of the line for a legend, at a height between two places in pixels.
    pub fn sample(self, area: &Area<'_>, from: i32, to: i32, y: i32) -> Drawn {
        let mut x = from;
        while x < to {
            let end = if self.gap == 0 { to } else { (x + self.dash).min(to) };
            segment(area, (x, y), (end, y), self.style())?;
            x = end + self.gap.max(1);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_as_many_digits_as_they_need() {
        let write = |span: Span<f64>, value| Digits::of(&span).write(value);
        assert_eq!(write(-10.0..10.0, -4.0), "-4");
        assert_eq!(write(0.4..1.0, 0.6), "0.60");
        assert_eq!(write(-1.0..1.0, -1e-17), "0.0");
        assert_eq!(write(40_806.1..40_806.2, 40_806.15), "40806.15");
        assert_eq!(write(0.0..4e9, 2e9), "2.0e9");
        assert_eq!(write(1e-6..3e-6, 2e-6), "2.00e-6");
    }

    #[test]
    fn spans_are_never_empty() {
        assert_eq!(span([1.0, 3.0].into_iter(), 0.5), 0.0..4.0);
        assert_eq!(span([f64::NAN, 5.0].into_iter(), 0.5), 4.5..5.5);
        assert_eq!(span([0.0].into_iter(), 0.5), -1.0..1.0);
        assert_eq!(span([f64::NAN].into_iter(), 0.5), 0.0..1.0);
        let rounding = span([49_980.8, 49_980.8 + 2e-11].into_iter(), 0.05);
        assert!(rounding.end - rounding.start > 9_000.0);
    }
}
