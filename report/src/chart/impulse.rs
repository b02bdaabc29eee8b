//! Routh's construction: the plane of the normal and the tangential impulse, in which each event of the collision is a line and each law a point.

use planar_impact_app::issue::Issues;
use planar_impact_app::solve::{Contact, ImpulsePlane, ImpulseRatioGiven, PlaneImpulse, Solution, TangentialLaw};
use planar_impact_app::units::{Measure, beyond_rounding};
use planar_impact_app::{Answer, Units};
use plotters::coord::CoordTranslate;
use plotters::prelude::{Circle, Color, DrawingArea, Polygon, RGBColor, SVGBackend, ShapeStyle, TriangleMarker, WHITE};

use super::canvas::{Area, Axes, BLUE, DARK, Drawn, GRAY, GREEN, Stroke, VERMILION, WIDTH, page, px, span, with_unit, write};
use super::labels::Labels;

const HEIGHT: u32 = px(600);
const LEGEND: u32 = px(262);
/// Width over height of the plane as drawn.
const ASPECT: f64 = 1.03;
/// A point beyond so many times the size of the impulse does not widen the frame.
const FARTHEST: f64 = 6.0;

/// A point or a direction in the plane: normal and tangential, in N s.
type Place = (f64, f64);

/// Draws the impulse plane of a solved collision; `None` where momentum alone determines the impulse.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn impulse(answer: &Answer<Solution>, units: Units) -> Result<Option<String>, Issues> {
    let Some(diagram) = Diagram::of(&answer.contact) else { return Ok(None) };
    let description = diagram.description(units);
    let title = if answer.title.is_empty() { "Impulse plane".to_owned() } else { format!("Impulse plane: {}", answer.title) };
    page(&title, &description, HEIGHT, |area| diagram.draw(area, units)).map(Some)
}

/// What a straight line of the diagram shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Role {
    SlidingEnd,
    MaximumCompression,
    Termination,
    /// An edge of the friction cone.
    Cone,
    CriticalRatio,
    /// From the origin to the impulse, at constant ratio.
    Path,
}

/// A law or an event with a point of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mark {
    CommonVelocity,
    Brach,
    KudlichSlibar,
    Solution,
}

/// The geometry of the diagram, in SI.
struct Diagram<'a> {
    contact: &'a Contact,
    frame: [std::ops::Range<f64>; 2],
    lines: Vec<(Role, [Place; 2])>,
    marks: Vec<(Mark, Place)>,
    /// The friction cone within the frame, as a polygon from the origin.
    cone: Vec<Place>,
}

fn place(impulse: &PlaneImpulse) -> Place {
    (impulse.normal, impulse.tangential)
}

impl<'a> Diagram<'a> {
    fn of(contact: &'a Contact) -> Option<Diagram<'a>> {
        let plane: &ImpulsePlane = contact.impulse_plane.as_ref()?;
        let solution = (contact.impulse.normal, contact.impulse.tangential);
        let marks = vec![
            (Mark::CommonVelocity, place(&plane.common_velocity)),
            (Mark::Brach, place(&plane.brach)),
            (Mark::KudlichSlibar, place(&plane.kudlich_slibar)),
            (Mark::Solution, solution),
        ];
        let frame = frame(&marks, solution);
        let k = &plane.compliance;
        let rows = [
            (Role::SlidingEnd, [k.coupling, k.tangential], plane.sliding_end),
            // At e = 0 they are one line, of which the dashes are drawn last.
            (Role::Termination, [k.normal, k.coupling], plane.termination),
            (Role::MaximumCompression, [k.normal, k.coupling], plane.maximum_compression),
        ];
        let mut lines: Vec<(Role, [Place; 2])> =
            rows.into_iter().filter_map(|(role, row, value)| Some((role, line_in(&frame, row, value)?))).collect();
        let ratio = cone_ratio(contact).abs();
        let edges = [ratio, -ratio].map(|ratio| ray_in(&frame, (solution.0, ratio * solution.0)));
        lines.push((Role::CriticalRatio, [(0.0, 0.0), ray_in(&frame, place(&plane.brach))]));
        lines.extend(edges.map(|edge| (Role::Cone, [(0.0, 0.0), edge])));
        lines.push((Role::Path, [(0.0, 0.0), solution]));
        let cone = polygon(&frame, edges, solution.0);
        Some(Diagram { contact, frame, lines, marks, cone })
    }

    fn description(&self, units: Units) -> String {
        let ratio = |value: f64| units.number(Measure::Ratio, value, 1.0);
        let [normal, tangential] = components(self.contact, units);
        format!(
            "The impulse on vehicle 1 is {normal} along the normal and {tangential} along the tangent, at the ratio {}; the critical ratio is {}. \
             The line where sliding ends meets the line of termination at the impulse of the critical ratio.",
            ratio(self.contact.impulse_ratio),
            ratio(self.contact.critical_impulse_ratio),
        )
    }

    fn draw(&self, area: &Area<'_>, units: Units) -> Drawn {
        let (plot, legend) = area.split_horizontally(WIDTH - LEGEND);
        let conversion = units.conversion(Measure::Impulse);
        let shown = |at: Place| (conversion.of_si(at.0), conversion.of_si(at.1));
        let unit = units.unit(Measure::Impulse);
        let [x, y] = self.frame.each_ref().map(|range| conversion.of_si(range.start)..conversion.of_si(range.end));
        let names = ["normal impulse P_n", "tangential impulse P_t"].map(|name| with_unit(name, unit));
        let axes = Axes { left: Axes::room(&y), x, y, x_name: &names[0], y_name: &names[1] };
        let mut chart = axes.draw(&plot)?;
        chart.draw_series([Polygon::new(self.cone.iter().map(|&at| shown(at)).collect::<Vec<_>>(), GREEN.mix(0.10))])?;
        // The axes of the plane, where they are within the frame.
        for row in [[0.0, 1.0], [1.0, 0.0]] {
            if let Some(ends) = line_in(&self.frame, row, 0.0) {
                Stroke::solid(GRAY, 1).line(&mut chart, ends.map(shown))?;
            }
        }
        let mut labels = Labels::default();
        for at in self.marks.iter().map(|(_, at)| *at).chain([(0.0, 0.0)]).filter(|at| is_inside(&self.frame, *at)) {
            labels.reserve(&chart, shown(at), 12);
        }
        for (role, ends) in &self.lines {
            role.stroke().line(&mut chart, ends.map(shown))?;
            if let Some(text) = role.label() {
                let along = |i: i32| between(ends[0], ends[1], 0.02 * f64::from(i));
                // Rays crowd at the origin.
                let first = if *role == Role::CriticalRatio { 20 } else { 0 };
                let points = (first..=50).map(along).map(shown).collect();
                labels.along(&chart, points, text);
            }
        }
        labels.draw(&plot)?;
        for (mark, at) in self.marks.iter().filter(|(_, at)| is_inside(&self.frame, *at)) {
            mark.draw(chart.plotting_area(), shown(*at))?;
        }
        self.legend(&legend, units)
    }

    fn legend(&self, area: &Area<'_>, units: Units) -> Drawn {
        let contact = self.contact;
        let ratio = |value: f64| if value.is_finite() { units.number(Measure::Ratio, value, 1.0) } else { "none".to_owned() };
        let fine = px(1) as i32;
        let mut y = 28;
        let roles = [
            (Role::SlidingEnd, "sliding ends".to_owned()),
            (Role::MaximumCompression, "maximum compression".to_owned()),
            (Role::Termination, format!("termination, e = {}", ratio(contact.restitution))),
            (Role::Cone, format!("{}, ±{}", cone_name(contact), ratio(cone_ratio(contact).abs()))),
            (Role::CriticalRatio, format!("critical ratio μ0 = {}", ratio(contact.critical_impulse_ratio))),
            (Role::Path, format!("impulse, at μ = {}", ratio(contact.impulse_ratio))),
        ];
        for (role, text) in roles {
            role.stroke().sample(area, 4, 48, y)?;
            write(area, &text, 15, (56, y - 7))?;
            y += 28;
        }
        let law = match contact.tangential_law {
            TangentialLaw::Brach => "by the law of Brach",
            TangentialLaw::KudlichSlibar => "by that of Kudlich and Slibar",
        };
        let [normal, tangential] = components(contact, units);
        let solution = ["impulse on vehicle 1", law, &format!("P_n = {normal}"), &format!("P_t = {tangential}")];
        // A moment impulse shifts the lines, but not by the restitution.
        let of_both = if contact.impulse.moment.is_some() { "restitution of both parts" } else { "common velocity times 1 + e" };
        let words: [&[&str]; 4] = [
            &["common velocity:", "e = 0, μ = μ0"],
            &["sticking by Brach: sliding", "has ended at termination"],
            &["sticking by Kudlich–Slibar:", of_both],
            &solution,
        ];
        y += 8;
        for ((mark, at), lines) in self.marks.iter().zip(words) {
            mark.draw(area, (26 * fine, y * fine))?;
            let outside = (!is_inside(&self.frame, *at)).then_some("(outside the frame)");
            for text in lines.iter().copied().chain(outside) {
                write(area, text, 15, (56, y - 7))?;
                y += 17;
            }
            y += 11;
        }
        Ok(())
    }
}

/// Returns the ratio of the edges of the friction cone: the friction that limits the ratio, or else the ratio itself.
fn cone_ratio(contact: &Contact) -> f64 {
    match (contact.impulse_ratio_given, contact.impulse_ratio_parameter) {
        (ImpulseRatioGiven::Friction, Some(friction)) => friction,
        _ => contact.impulse_ratio,
    }
}

fn cone_name(contact: &Contact) -> &'static str {
    if contact.impulse_ratio_given == ImpulseRatioGiven::Friction { "friction cone" } else { "cone of the ratio" }
}

impl Role {
    fn stroke(self) -> Stroke {
        match self {
            Role::SlidingEnd => Stroke::solid(DARK, 2),
            Role::MaximumCompression => Stroke::dashed(BLUE, 2, 10, 5),
            Role::Termination => Stroke::solid(VERMILION, 2),
            Role::Cone => Stroke::dashed(GREEN, 2, 3, 4),
            Role::CriticalRatio => Stroke::dashed(GRAY, 1, 16, 5),
            Role::Path => Stroke::solid(BLUE, 4),
        }
    }

    /// Returns the words on the line itself.
    fn label(self) -> Option<&'static str> {
        match self {
            Role::SlidingEnd => Some("sliding ends"),
            Role::MaximumCompression => Some("compression"),
            Role::Termination => Some("termination"),
            Role::CriticalRatio => Some("μ0"),
            Role::Cone | Role::Path => None,
        }
    }
}

impl Mark {
    fn draw<C: CoordTranslate>(self, area: &DrawingArea<SVGBackend<'_>, C>, at: C::From) -> Drawn
    where
        C::From: Clone,
    {
        let outlined = |color: RGBColor| ShapeStyle::from(&color).stroke_width(px(2));
        match self {
            Mark::CommonVelocity => {
                area.draw(&Circle::new(at.clone(), px(5), WHITE.filled()))?;
                area.draw(&Circle::new(at, px(5), outlined(BLUE)))?;
            }
            Mark::Brach => area.draw(&TriangleMarker::new(at, px(8), DARK.filled()))?,
            Mark::KudlichSlibar => {
                area.draw(&TriangleMarker::new(at.clone(), px(8), VERMILION.filled()))?;
                area.draw(&Circle::new(at, px(2), WHITE.filled()))?;
            }
            Mark::Solution => {
                area.draw(&Circle::new(at.clone(), px(10), outlined(DARK)))?;
                area.draw(&Circle::new(at, px(3), DARK.filled()))?;
            }
        }
        Ok(())
    }
}

/// Returns the ranges of the normal and the tangential impulse: around the origin and the points, at equal scales unless one of them would be flat.
fn frame(marks: &[(Mark, Place)], solution: Place) -> [std::ops::Range<f64>; 2] {
    /// Flattest shape of the points at equal scales, and that which is drawn like a line.
    const FLATTEST: f64 = 0.3;
    const LINE: f64 = 0.02;
    let reach = FARTHEST * libm::hypot(solution.0, solution.1);
    let near = || marks.iter().map(|(_, at)| *at).filter(|at| libm::hypot(at.0, at.1) <= reach).chain([(0.0, 0.0)]);
    let mut x = span(near().map(|at| at.0), 0.15);
    let mut y = span(near().map(|at| at.1), 0.15);
    let (wide, high) = (x.end - x.start, ASPECT * (y.end - y.start));
    let tangential = near().map(|at| at.1.abs()).fold(0.0, f64::max);
    let is_line = ASPECT * tangential < LINE * wide;
    if is_line {
        let half = 0.5 * wide / ASPECT;
        y = -half..half;
    } else if high < wide {
        if high > FLATTEST * wide {
            y = widened(&y, wide / ASPECT);
        }
    } else if wide > FLATTEST * high {
        x = widened(&x, high);
    }
    [x, y]
}

/// Returns a range with the same middle and another length.
fn widened(range: &std::ops::Range<f64>, length: f64) -> std::ops::Range<f64> {
    let middle = 0.5 * (range.start + range.end);
    middle - 0.5 * length..middle + 0.5 * length
}

fn is_inside(frame: &[std::ops::Range<f64>; 2], at: Place) -> bool {
    let within = |range: &std::ops::Range<f64>, value: f64| (range.start..=range.end).contains(&value);
    within(&frame[0], at.0) && within(&frame[1], at.1)
}

fn between(from: Place, to: Place, share: f64) -> Place {
    (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
}

/// Returns the part within the frame of the line on which `row` · P has a value; `None` if there is none.
fn line_in(frame: &[std::ops::Range<f64>; 2], row: [f64; 2], value: f64) -> Option<[Place; 2]> {
    let length = libm::hypot(row[0], row[1]);
    // The foot of the perpendicular from the origin, and the direction of the line.
    let foot = (value * row[0] / length / length, value * row[1] / length / length);
    let direction = (-row[1] / length, row[0] / length);
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (range, at, along) in [(&frame[0], foot.0, direction.0), (&frame[1], foot.1, direction.1)] {
        if along == 0.0 {
            if !(range.start..=range.end).contains(&at) {
                return None;
            }
            continue;
        }
        let ends = [(range.start - at) / along, (range.end - at) / along];
        low = low.max(ends[0].min(ends[1]));
        high = high.min(ends[0].max(ends[1]));
    }
    let point = |share: f64| (foot.0 + share * direction.0, foot.1 + share * direction.1);
    (low < high).then(|| [point(low), point(high)])
}

/// Returns the place where the ray from the origin in a direction leaves the frame, which contains the origin.
fn ray_in(frame: &[std::ops::Range<f64>; 2], direction: Place) -> Place {
    let to_edge = |range: &std::ops::Range<f64>, along: f64| match along {
        along if along > 0.0 => range.end / along,
        along if along < 0.0 => range.start / along,
        _ => f64::INFINITY,
    };
    let share = to_edge(&frame[0], direction.0).min(to_edge(&frame[1], direction.1));
    if share.is_finite() { (share * direction.0, share * direction.1) } else { (0.0, 0.0) }
}

/// Returns the part of the cone between two edges within the frame: with each corner of the frame that lies between them.
fn polygon(frame: &[std::ops::Range<f64>; 2], edges: [Place; 2], normal: f64) -> Vec<Place> {
    let slope = |at: Place| at.1 / at.0;
    let limit = slope(edges[0]).abs();
    let mut corners: Vec<Place> =
        [(frame[0].start, frame[1].start), (frame[0].start, frame[1].end), (frame[0].end, frame[1].start), (frame[0].end, frame[1].end)]
            .into_iter()
            .filter(|corner| corner.0 * normal > 0.0 && slope(*corner).abs() <= limit)
            .chain(edges)
            .collect();
    corners.sort_by(|one, other| slope(*one).total_cmp(&slope(*other)));
    std::iter::once((0.0, 0.0)).chain(corners).collect()
}

/// Formats the impulse along the normal and along the tangent, 0 where it is rounding.
fn components(contact: &Contact, units: Units) -> [String; 2] {
    let (normal, tangential) = (contact.impulse.normal, contact.impulse.tangential);
    let size = libm::hypot(normal, tangential);
    [normal, tangential].map(|value| units.quantity(Measure::Impulse, beyond_rounding(value, size)))
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, hostile, pairs, solved};
    use super::*;

    fn close(one: f64, other: f64, size: f64, what: &str) {
        assert!((one - other).abs() <= size, "{what}: {one}, not {other}");
    }

    fn mark(diagram: &Diagram<'_>, which: Mark) -> Place {
        diagram.marks.iter().find(|(mark, _)| *mark == which).expect("a mark").1
    }

    /// Returns the distance of a place from the line of a role, if the frame has the line.
    fn distance(diagram: &Diagram<'_>, role: Role, at: Place) -> Option<f64> {
        let (_, [from, to]) = diagram.lines.iter().find(|(found, _)| *found == role)?;
        let along = (to.0 - from.0, to.1 - from.1);
        Some(((at.0 - from.0) * along.1 - (at.1 - from.1) * along.0) / along.0.hypot(along.1))
    }

    #[test]
    fn the_solution_is_where_the_lines_of_its_law_meet() {
        let (mut sticking, mut sliding, mut other_law, mut with_moment, mut held) = (0, 0, 0, 0, 0);
        for [answer, _] in pairs(300) {
            let contact = &answer.contact;
            let diagram = Diagram::of(contact).expect("an angular model");
            let solution = mark(&diagram, Mark::Solution);
            let size = 1e-9 * solution.0.hypot(solution.1);
            let on = |role, at, what: &str| distance(&diagram, role, at).iter().for_each(|off| close(*off, 0.0, 10.0 * size, what));
            assert!(is_inside(&diagram.frame, solution) && is_inside(&diagram.frame, (0.0, 0.0)));
            on(Role::Termination, solution, "the solution on the line of termination");
            assert!(distance(&diagram, Role::Termination, solution).is_some(), "the frame has the line");
            close(solution.1, contact.impulse_ratio * solution.0, size, "the solution on the ray of its ratio");
            on(Role::Path, solution, "the path ends at the solution");
            let common = mark(&diagram, Mark::CommonVelocity);
            let large = 1e-9 * common.0.hypot(common.1);
            if is_inside(&diagram.frame, common) {
                on(Role::MaximumCompression, common, "common velocity at maximum compression");
                on(Role::SlidingEnd, common, "common velocity where sliding ends");
            }
            for point in [Mark::Brach, Mark::KudlichSlibar]
                .map(|which| mark(&diagram, which))
                .into_iter()
                .filter(|at| is_inside(&diagram.frame, *at))
            {
                on(Role::Termination, point, "both laws at termination");
            }
            let brach = mark(&diagram, Mark::Brach);
            if is_inside(&diagram.frame, brach) {
                on(Role::SlidingEnd, brach, "sticking where sliding ends");
            }
            close(brach.1, contact.critical_impulse_ratio * brach.0, 1e-9 * brach.0.hypot(brach.1), "the critical ratio");
            if contact.impulse.moment.is_none() {
                // Restitution multiplies the impulse to common velocity.
                let (both, other) = (1.0 + contact.restitution, mark(&diagram, Mark::KudlichSlibar));
                close(other.0, both * common.0, 10.0 * large, "normal");
                close(other.1, both * common.1, 10.0 * large, "tangential");
            } else {
                with_moment += 1;
            }
            let of_law = if contact.tangential_law == TangentialLaw::Brach { Mark::Brach } else { Mark::KudlichSlibar };
            if contact.impulse_ratio_given == ImpulseRatioGiven::Critical {
                let sticks = mark(&diagram, of_law);
                close(solution.0, sticks.0, size, "sticking");
                close(solution.1, sticks.1, size, "sticking");
                sticking += 1;
                other_law += usize::from(of_law == Mark::KudlichSlibar && contact.restitution > 0.0);
            } else {
                sliding += 1;
            }
            // The cone has the solution on its edge, or within it where friction does not limit the impulse.
            assert!(solution.1.abs() <= cone_ratio(contact).abs() * solution.0.abs() + size);
            if let (ImpulseRatioGiven::Friction, Some(friction)) = (contact.impulse_ratio_given, contact.impulse_ratio_parameter) {
                // Where less than the friction holds the vehicles together, the cone is that of the friction.
                held += usize::from(contact.impulse_ratio.abs() < 0.99 * friction);
                let (_, [_, edge]) = diagram.lines.iter().find(|(role, _)| *role == Role::Cone).expect("a cone");
                close(edge.1.abs(), friction * edge.0.abs(), 1e-9 * edge.0.abs(), "the edge of the cone");
            }
        }
        assert!(
            [sticking, sliding, other_law, with_moment, held].iter().all(|count| *count > 20),
            "{sticking} {sliding} {other_law} {with_moment} {held}"
        );
    }

    #[test]
    fn both_scales_are_equal_unless_the_points_are_flat() {
        for (point, is_equal) in [((10.0, 5.0), true), ((10.0, 1.0), false), ((5.0, 10.0), true), ((1.0, 10.0), false), ((10.0, 0.0), true)]
        {
            let [x, y] = frame(&[(Mark::Solution, point)], point);
            let ratio = ASPECT * (y.end - y.start) / (x.end - x.start);
            assert_eq!((ratio - 1.0).abs() < 1e-12, is_equal, "{point:?}: {ratio}");
            assert!(is_inside(&[x, y], point));
        }
    }

    #[test]
    fn a_mirror_image_has_the_mirrored_diagram() {
        for [one, other] in pairs(200) {
            let [one, other] = [&one, &other].map(|answer| Diagram::of(&answer.contact).expect("an angular model"));
            let size = 1e-7 * (one.frame[0].end - one.frame[0].start).max(one.frame[1].end - one.frame[1].start);
            close(one.frame[1].start, -other.frame[1].end, size, "frame");
            close(one.frame[0].start, other.frame[0].start, size, "frame");
            for ((mark, at), (_, mirrored)) in one.marks.iter().zip(&other.marks) {
                let size = size.max(1e-9 * at.0.hypot(at.1));
                close(at.0, mirrored.0, size, &format!("{mark:?}"));
                close(at.1, -mirrored.1, size, &format!("{mark:?}"));
            }
            for role in [Role::SlidingEnd, Role::MaximumCompression, Role::Termination] {
                let ends = |diagram: &Diagram<'_>| diagram.lines.iter().find(|(found, _)| *found == role).map(|(_, ends)| *ends);
                if let (Some(ends), Some(_)) = (ends(&one), ends(&other)) {
                    for end in ends {
                        close(distance(&other, role, (end.0, -end.1)).expect("a line"), 0.0, size, "line");
                    }
                }
            }
        }
    }

    #[test]
    fn every_line_is_within_the_frame() {
        for [answer, _] in pairs(150) {
            let diagram = Diagram::of(&answer.contact).expect("an angular model");
            let [x, y] = &diagram.frame;
            let (wide, high) = (1e-9 * (x.end - x.start), 1e-9 * (y.end - y.start));
            for at in diagram.lines.iter().flat_map(|(_, ends)| *ends).chain(diagram.cone.iter().copied()) {
                assert!(at.0 >= x.start - wide && at.0 <= x.end + wide && at.1 >= y.start - high && at.1 <= y.end + high, "{at:?}");
            }
        }
    }

    const HEAD_ON: &str = "schema = 1\ntitle = \"TITLE\"\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"0 deg\"\nspeed = 15\nimpact_center = [2, 0]\n\
        [[vehicle]]\nname = \"wall\"\nbarrier = true\n[contact]\ncrush_plane = \"0 deg\"\nrestitution = 0.1\n";

    #[test]
    fn every_diagram_is_legible() {
        for [answer, _] in pairs(120) {
            for units in [Units::Us, Units::Si] {
                assert_legible(&impulse(&answer, units).expect("in memory").expect("a diagram"));
            }
        }
        // Central, so that all is along the normal; a given negative ratio of nothing; a hostile title.
        let central = solved(&HEAD_ON.replace("TITLE", "central")).expect("a solution");
        assert_legible(&impulse(&central, Units::Si).expect("in memory").expect("a diagram"));
        let title = hostile().replace(['\u{1}', '\u{202e}', '\u{fffe}'], "").replace('"', "'");
        let mut loud = solved(&HEAD_ON.replace("TITLE", &title)).expect("a solution");
        loud.title = hostile();
        assert_legible(&impulse(&loud, Units::Us).expect("in memory").expect("a diagram"));
    }
}
