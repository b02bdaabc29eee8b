//! Reads drawings of scenes back: arrows, headings, crushed sides and clocks have the signs of the numbers, in random cases and in their mirror images.
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![allow(clippy::disallowed_methods)]

use planar_impact_app::scene::{Scene, draw};
use planar_impact_app::{Answer, Case, Source, Uncontrolled, Units, solve};
use planar_impact_report::scene::scene;
use planar_impact_report::svg::text_width;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use roxmltree::{Document, Node};

const SURFACES: [&str; 4] = ["front", "right", "rear", "left"];

/// The numbers of a random case, as a file gives them; `mirror` is −1 for its image in the x axis.
struct Random {
    mirror: f64,
    heading: [f64; 2],
    speed: [f64; 2],
    center: [[f64; 2]; 2],
    yaw_rate: [f64; 2],
    plane: f64,
    restitution: f64,
    surface: [usize; 2],
    length: f64,
}

impl Random {
    fn draw(rng: &mut ChaCha8Rng) -> Random {
        let mut between = |low: f64, high: f64| rng.random_range(low..high);
        Random {
            mirror: 1.0,
            heading: [between(-3.1, 3.1), between(-3.1, 3.1)],
            speed: [between(5.0, 25.0), between(-5.0, 25.0)],
            center: [[between(0.8, 2.0), between(-0.8, 0.8)], [between(-2.0, 2.0), between(-0.8, 0.8)]],
            yaw_rate: [between(-1.0, 1.0), between(-1.0, 1.0)],
            plane: between(-3.1, 3.1),
            restitution: between(0.0, 0.3),
            surface: [rng.random_range(0..4), rng.random_range(0..4)],
            length: rng.random_range(4.0..5.5),
        }
    }

    fn mirrored(self) -> Random {
        Random { mirror: -1.0, ..self }
    }

    fn surface(&self, i: usize) -> &'static str {
        match (SURFACES[self.surface[i]], self.mirror < 0.0) {
            ("right", true) => "left",
            ("left", true) => "right",
            (surface, _) => surface,
        }
    }

    fn text(&self) -> String {
        let m = self.mirror;
        let vehicle = |i: usize| {
            format!(
                "[[vehicle]]\nname = \"car {}\"\nmass = 1500\nyaw_inertia = 2500\nheading = {}\nspeed = {}\nyaw_rate = {}\nimpact_center = [{}, {}]\n\
                 length = {}\nwidth = 1.9\ncrush = {{ width = 1.2, depths = [0.1, 0.3, 0.2], stiffness = {{ A = 40000, B = 500000 }}, surface = \"{}\" }}\n",
                i + 1,
                m * self.heading[i],
                self.speed[i],
                m * self.yaw_rate[i],
                self.center[i][0],
                m * self.center[i][1],
                self.length,
                self.surface(i),
            )
        };
        let contact = format!("[contact]\ncrush_plane = {}\nrestitution = {}\n", m * self.plane, self.restitution);
        format!("schema = 1\ntitle = \"random\"\n{}{}{contact}", vehicle(0), vehicle(1))
    }

    /// The case, if the physics accepts it.
    fn case(&self) -> Option<(Case, Answer<Scene>)> {
        let case = Case::parse(Source::new("random.toml", self.text())).expect("a readable file");
        let answer = draw(&case, &(), &Uncontrolled).ok()?;
        Some((case, answer))
    }
}

/// Returns an element by one of its classes.
fn of_class<'a, 'b>(under: Node<'a, 'b>, class: &str) -> Node<'a, 'b> {
    let has = |node: &Node<'_, '_>| node.attribute("class").is_some_and(|classes| classes.split(' ').any(|one| one == class));
    under.descendants().find(has).unwrap_or_else(|| panic!("nothing of class {class}"))
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

/// Returns the points of a polygon, y up.
fn points(node: Node<'_, '_>) -> Vec<[f64; 2]> {
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        [x.parse().expect("x"), -y.parse::<f64>().expect("y")]
    };
    node.attribute("points").expect("points").split(' ').map(pair).collect()
}

fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Node<'a, 'b> {
    node.children().find(|child| child.has_tag_name(name)).unwrap_or_else(|| panic!("no {name} in {node:?}"))
}

/// Returns an arrow from its tail to its tip, y up.
fn arrow(node: Node<'_, '_>) -> [f64; 2] {
    let line = child(node, "line");
    let tip = points(child(node, "polygon"))[0];
    [tip[0] - number(line, "x1"), tip[1] + number(line, "y1")]
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Asserts that an arrow in pixels points along a vector, `scale` pixels for a unit, to the rounding of pixels.
fn assert_along(arrow: [f64; 2], vector: [f64; 2], scale: f64, what: &str) {
    for k in 0..2 {
        assert!((arrow[k] - scale * vector[k]).abs() < 0.05, "{what}: {arrow:?} is not {scale} times {vector:?}");
    }
}

/// Compares a drawing with the numbers of `solve`.
fn compare(random: &Random, case: &Case, answer: &Answer<Scene>) {
    let svg = scene(answer, Units::Si);
    let page = Document::parse(&svg).expect("well-formed");
    let solution = solve::solve(case, &(), &Uncontrolled).expect("solved as it was drawn");
    let root = page.root_element();
    let velocities: Vec<[f64; 2]> = solution.vehicles.iter().flat_map(|vehicle| [vehicle.before.velocity, vehicle.velocity]).collect();
    let fastest = velocities.iter().copied().max_by(|a, b| length(*a).total_cmp(&length(*b))).expect("four");
    let longest = (1..=2)
        .flat_map(|k| ["before", "after"].map(|when| length(arrow(of_class(root, &format!("velocity-{when}-{k}"))))))
        .fold(0.0, f64::max);
    let scale = longest / length(fastest);
    let impulse = [solution.contact.impulse.x, solution.contact.impulse.y];
    for (i, vehicle) in solution.vehicles.iter().enumerate() {
        let k = i + 1;
        let drawn = of_class(root, &format!("vehicle-{k}"));
        assert_along(arrow(of_class(root, &format!("velocity-before-{k}"))), vehicle.before.velocity, scale, "before");
        assert_along(arrow(of_class(root, &format!("velocity-after-{k}"))), vehicle.velocity, scale, "after");
        let sign = [1.0, -1.0][i];
        let on = arrow(of_class(root, &format!("impulse-{k}")));
        assert_along(on, impulse.map(|part| sign * part), length(on) / length(impulse), "impulse");
        // The heading runs from the center of mass to the middle of the front; length and width are to scale.
        let heading = of_class(drawn, "heading");
        let ahead = [number(heading, "x2") - number(heading, "x1"), number(heading, "y1") - number(heading, "y2")];
        let angle = random.mirror * random.heading[i];
        assert_along(ahead, [angle.cos(), angle.sin()], length(ahead), "heading");
        let corners = points(of_class(drawn, "outline"));
        let side = |a: usize, b: usize| length([0, 1].map(|axis| corners[a][axis] - corners[b][axis]));
        assert!((side(0, 3) / side(0, 1) - random.length / 1.9).abs() < 1e-3, "outline of {} by {}", side(0, 3), side(0, 1));
        let per_meter = side(0, 3) / random.length;
        assert!((length(ahead) / per_meter - random.length / 2.0).abs() < 1e-3);
        // The impact center is where the vehicle has it.
        let center = of_class(root, "impact-center");
        let circle = child(center, "circle");
        let from = [number(circle, "cx") - number(heading, "x1"), number(heading, "y1") - number(circle, "cy")];
        let [forward, left] = [random.center[i][0], random.mirror * random.center[i][1]];
        let (sin, cos) = angle.sin_cos();
        assert_along(from, [forward * cos - left * sin, forward * sin + left * cos], per_meter, "impact center");
        // The crushed side is the one that the file names.
        let damage = of_class(drawn, &format!("damage-{}", random.surface(i)));
        let ring = points(damage);
        let edge = [ring[0], ring[2]];
        let middle = [0, 1].map(|axis| (edge[0][axis] + edge[1][axis]) / 2.0 - [number(heading, "x1"), -number(heading, "y1")][axis]);
        let outward = [middle[0] * cos + middle[1] * sin, -middle[0] * sin + middle[1] * cos];
        let (half_length, half_width) = (random.length / 2.0 * per_meter, 0.95 * per_meter);
        let (axis, wanted) = match random.surface(i) {
            "front" => (0, half_length),
            "rear" => (0, -half_length),
            "left" => (1, half_width),
            _ => (1, -half_width),
        };
        assert!((outward[axis] - wanted).abs() < 0.1, "{}: {outward:?}, not {wanted}", random.surface(i));
        // Depths go inward, to scale: 0.3 m in the middle.
        let deepest = [0, 1].map(|axis| ring[4][axis] - ring[1][axis]);
        assert!((length(deepest) - 0.3 * per_meter).abs() < 0.05);
        assert!((deepest[0] * cos + deepest[1] * sin) * [1.0, 0.0][axis] * wanted <= 0.0);
        // The hand of the clock comes from the principal direction of force, clockwise from 12.
        let clock = of_class(root, &format!("clock-{k}"));
        let (hand, face) = (of_class(clock, "pdof"), child(clock, "circle"));
        let from = [number(hand, "x1") - number(face, "cx"), number(face, "cy") - number(hand, "y1")];
        assert_along(from, [vehicle.pdof.sin(), vehicle.pdof.cos()], length(from), "pdof");
        assert!(svg.contains(&format!("{} o&apos;clock", answer.vehicles[i].pdof_clock())), "{}", vehicle.pdof);
    }
    for (i, vehicle) in solution.vehicles.iter().enumerate() {
        // An arc with the sweep flag 0 turns counter-clockwise on the page; it starts left of the vehicle.
        let path = child(of_class(root, &format!("rotation-{}", i + 1)), "path").attribute("d").expect("an arc");
        let words: Vec<&str> = path.split(' ').collect();
        assert_eq!(words[8], if vehicle.yaw_rate > 0.0 { "0" } else { "1" }, "{path} of {}", vehicle.yaw_rate);
        let center = of_class(of_class(root, &format!("vehicle-{}", i + 1)), "center-of-mass");
        let start = [1, 2].map(|k| words[k].parse::<f64>().expect("a number"));
        let from = [start[0] - number(center, "cx"), number(center, "cy") - start[1]];
        let angle = random.mirror * random.heading[i];
        assert_along(from, [-angle.sin(), angle.cos()], length(from), "start of the rotation");
        // The small pictures: before, at maximum compression and after, all at one scale.
        let share = 1.0 / (1.0 + random.restitution);
        let compressed = [0, 1].map(|k| vehicle.before.velocity[k] + share * vehicle.delta_v[k]);
        for (phase, velocity) in [("before", vehicle.before.velocity), ("maximum-compression", compressed), ("after", vehicle.velocity)] {
            let picture = of_class(root, &format!("phase-{phase}"));
            let class = format!("phase-velocity-{}", i + 1);
            if length(velocity) > 0.03 * length(fastest) {
                let line = of_class(picture, &class);
                let drawn = [number(line, "x2") - number(line, "x1"), number(line, "y1") - number(line, "y2")];
                assert_along(drawn, velocity, 44.0 / length(fastest), phase); // a quarter of 176 pixels
            }
        }
    }
    // n is at the angle of the crush plane, t a quarter turn further.
    for (class, angle) in [("normal", 0.0), ("tangent", std::f64::consts::FRAC_PI_2)] {
        let line = of_class(of_class(root, "crush-plane"), class);
        let along = [number(line, "x2") - number(line, "x1"), number(line, "y1") - number(line, "y2")];
        let angle = random.mirror * random.plane + angle;
        assert_along(along, [angle.cos(), angle.sin()], length(along), class);
    }
    no_label_covers_another(root);
    all_panels_are_framed(root);
}

/// Asserts that texts neither overlap nor leave the page, with the width of the widest font.
fn no_label_covers_another(root: Node<'_, '_>) {
    let page = [number(root, "width"), number(root, "height")];
    let mut boxes: Vec<([f64; 4], String)> = Vec::new();
    for node in root.descendants().filter(|node| node.has_tag_name("text")) {
        let (text, size) = (node.text().unwrap_or_default(), number(node, "font-size"));
        let width = text_width(text, size);
        let left = number(node, "x")
            - width
                * match node.attribute("text-anchor") {
                    Some("middle") => 0.5,
                    Some("end") => 1.0,
                    _ => 0.0,
                };
        let base = number(node, "y");
        let place = [left, left + width, base - 0.75 * size, base + 0.2 * size];
        assert!(place[0] >= 0.0 && place[1] <= page[0] && place[2] >= 0.0 && place[3] <= page[1], "`{text}` leaves the page: {place:?}");
        for (other, name) in &boxes {
            let apart = place[0] >= other[1] || other[0] >= place[1] || place[2] >= other[3] || other[2] >= place[3];
            assert!(apart, "`{text}` covers `{name}`");
        }
        boxes.push((place, text.to_owned()));
    }
}

#[test]
fn drawings_have_the_signs_of_the_numbers_and_of_their_mirror_images() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    let (mut drawn, mut tried) = (0, 0);
    while drawn < 200 {
        tried += 1;
        assert!(tried < 4000, "the physics refuses too many: {drawn} of {tried}");
        let random = Random::draw(&mut rng);
        let Some((case, answer)) = random.case() else { continue };
        compare(&random, &case, &answer);
        let mirrored = random.mirrored();
        let (case, image) = mirrored.case().expect("the physics has no left and right");
        compare(&mirrored, &case, &image);
        drawn += 1;
    }
}

/// A drawing of a case with one line replaced.
fn altered(from: &str, to: &str) -> (Answer<Scene>, String) {
    let text = include_str!("../../cli/examples/position-a.toml");
    assert_eq!(text.matches(from).count(), 1, "{from}");
    let case = Case::parse(Source::new("altered.toml", text.replace(from, to))).expect("a readable file");
    let answer = draw(&case, &(), &Uncontrolled).expect("a possible collision");
    let svg = scene(&answer, Units::Us);
    (answer, svg)
}

#[test]
fn an_uncertain_speed_has_a_band_along_its_arrow() {
    let text = include_str!("../../cli/examples/position-a.toml").replacen("40 ft/s", "40 ft/s ± 4 ft/s", 1);
    let case = Case::parse(Source::new("uncertain.toml", text)).expect("a readable file");
    let svg = scene(&draw(&case, &(), &Uncontrolled).expect("a possible collision"), Units::Us);
    let page = Document::parse(&svg).expect("well-formed");
    let root = page.root_element();
    let (band, before) = (of_class(root, "speed-range-1"), of_class(root, "velocity-before-1"));
    let along = [number(band, "x2") - number(band, "x1"), number(band, "y1") - number(band, "y2")];
    // 1.96 standard deviations to each side of 40 ft/s.
    let share = 2.0 * 1.959_963_984_540_054 * 4.0 / 40.0;
    assert_along(along, arrow(before), share, "band");
    assert!(root.descendants().all(|node| !node.attribute("class").unwrap_or_default().contains("speed-range-2")));
    // The sector of the clock is as wide as the range of the principal direction of force.
    let sector = of_class(of_class(root, "clock-1"), "pdof-range").attribute("d").expect("a sector");
    assert!(sector.contains(" 0 0 1 "), "{sector}");
}

#[test]
fn uncertain_inputs_have_an_ellipse_at_the_tip_of_the_velocity_after() {
    // Of both speeds, one after the other in the file.
    let text = include_str!("../../cli/examples/position-a.toml").replace("40 ft/s", "40 ft/s ± 4 ft/s");
    let case = Case::parse(Source::new("uncertain.toml", text)).expect("a readable file");
    let answer = draw(&case, &(), &Uncontrolled).expect("a possible collision");
    let svg = scene(&answer, Units::Us);
    let page = Document::parse(&svg).expect("well-formed");
    let root = page.root_element();
    for (i, vehicle) in answer.vehicles.iter().enumerate() {
        let found = vehicle.after.velocity_sd.expect("uncertain inputs");
        assert!(found.sd[1] > 0.05 * found.sd[0], "two inputs spread it in two directions: {found:?}");
        let ellipse = of_class(root, &format!("velocity-sd-{}", i + 1)).children().find(|node| node.has_tag_name("ellipse"));
        let ellipse = ellipse.expect("an ellipse");
        let after = of_class(root, &format!("velocity-after-{}", i + 1));
        let line = after.children().find(|node| node.has_tag_name("line")).expect("an arrow");
        let length = (number(ellipse, "cx") - number(line, "x1")).hypot(number(ellipse, "cy") - number(line, "y1"));
        for (axis, sd) in ["rx", "ry"].into_iter().zip(found.sd) {
            let wanted = 2.0 * sd / vehicle.speed_after() * length;
            assert!((number(ellipse, axis) - wanted).abs() < 0.02, "{axis}: {}, not {wanted}", number(ellipse, axis));
        }
        let place = [(number(ellipse, "cx") - number(line, "x1")), (number(line, "y1") - number(ellipse, "cy"))];
        assert_along(place, vehicle.after.velocity, length / vehicle.speed_after(), "center");
        let turn = ellipse.attribute("transform").expect("a rotation").trim_start_matches("rotate(");
        let turn: f64 = turn.split(' ').next().and_then(|angle| angle.parse().ok()).expect("an angle");
        assert!((turn + found.angle.to_degrees()).abs() < 0.01, "{turn} for {found:?}");
    }
}

#[test]
fn a_rest_position_has_two_standard_deviations_around_it() {
    let text = include_str!("../../cli/examples/to-rest.toml");
    let case = Case::parse(Source::new("to-rest.toml", text)).expect("a readable file");
    let answer = draw(&case, &(), &Uncontrolled).expect("a possible collision");
    let svg = scene(&answer, Units::Si);
    let page = Document::parse(&svg).expect("well-formed");
    let root = page.root_element();
    for (i, vehicle) in answer.vehicles.iter().enumerate() {
        let rest = vehicle.rest.as_ref().expect("a rest position");
        let given = of_class(of_class(root, "overview"), &format!("given-rest-{}", i + 1));
        let ellipse = child(given, "ellipse");
        // The path of the slide is to the same scale.
        let path = points(of_class(root, &format!("path-{}", i + 1)));
        let slide = &vehicle.slide.as_ref().expect("a slide").path;
        let drawn = length([0, 1].map(|k| path[path.len() - 1][k] - path[0][k]));
        let (first, last) = (slide.first().expect("a state"), slide.last().expect("a state"));
        let scale = drawn / length([last.x - first.x, last.y - first.y]);
        assert!((number(ellipse, "rx") - 2.0 * rest.position_sd[0] * scale).abs() < 0.05, "{scale}");
        assert!((number(ellipse, "ry") - 2.0 * rest.position_sd[1] * scale).abs() < 0.05);
        let from_start = [number(ellipse, "cx") - path[0][0], -number(ellipse, "cy") - path[0][1]];
        assert_along(from_start, [rest.position[0] - first.x, rest.position[1] - first.y], scale, "rest");
    }
    no_label_covers_another(root);
}

/// Returns the places of what an element draws, in pixels to the right and down.
fn places(node: Node<'_, '_>) -> Vec<[f64; 2]> {
    let of = |name: &str| number(node, name);
    match node.tag_name().name() {
        "line" => vec![[of("x1"), of("y1")], [of("x2"), of("y2")]],
        "polygon" | "polyline" => points(node).into_iter().map(|[x, y]| [x, -y]).collect(),
        "circle" => [-1.0, 1.0].map(|sign| [of("cx") + sign * of("r"), of("cy") + sign * of("r")]).to_vec(),
        "ellipse" => [-1.0, 1.0].map(|sign| [of("cx") + sign * of("rx"), of("cy") + sign * of("ry")]).to_vec(),
        _ => Vec::new(),
    }
}

/// Asserts that all that a panel draws is within its frame, which stands before it.
fn all_is_framed(panel: Node<'_, '_>) {
    let frame = panel.prev_siblings().find(|node| node.has_tag_name("rect")).expect("a frame");
    let (low, size) = (["x", "y"].map(|name| number(frame, name)), ["width", "height"].map(|name| number(frame, name)));
    for node in panel.descendants() {
        for place in places(node) {
            let is_inside = (0..2).all(|k| place[k] >= low[k] && place[k] <= low[k] + size[k]);
            assert!(is_inside, "{place:?} of {node:?} leaves the frame at {low:?} of {size:?}");
        }
    }
}

/// Asserts the same of the pictures of the phases, and of that of skids and rest positions.
fn all_panels_are_framed(root: Node<'_, '_>) {
    let is_panel = |node: &Node<'_, '_>| {
        node.attribute("class").is_some_and(|classes| classes.split(' ').any(|class| class == "phase" || class == "overview"))
    };
    let panels: Vec<Node<'_, '_>> = root.descendants().filter(is_panel).collect();
    assert!(panels.len() >= 3, "{} panels", panels.len());
    panels.into_iter().for_each(all_is_framed);
}

#[test]
fn walls_are_within_their_frames() {
    let mut rng = ChaCha8Rng::seed_from_u64(23);
    let (mut drawn, mut tried) = (0, 0);
    while drawn < 100 {
        tried += 1;
        assert!(tried < 2000, "the physics refuses too many: {drawn} of {tried}");
        let mut between = |low: f64, high: f64| rng.random_range(low..high);
        let text = format!(
            "schema = 1\n[[vehicle]]\nname = \"car\"\nmass = 1500\nyaw_inertia = 2400\nheading = {}\nspeed = {}\nimpact_center = [{}, {}]\n\
             [[vehicle]]\nname = \"wall\"\nbarrier = true\n[contact]\ncrush_plane = {}\nrestitution = {}\n",
            between(-3.1, 3.1),
            between(3.0, 25.0),
            between(0.8, 2.2),
            between(-0.8, 0.8),
            between(-3.1, 3.1),
            between(0.0, 0.3),
        );
        let case = Case::parse(Source::new("barrier.toml", text)).expect("a readable file");
        let Ok(answer) = draw(&case, &(), &Uncontrolled) else { continue };
        let svg = scene(&answer, Units::Si);
        let page = Document::parse(&svg).expect("well-formed");
        let root = page.root_element();
        all_panels_are_framed(root);
        // The frame of the picture of the impact is the first one.
        let frame = root.children().filter(|node| node.has_tag_name("rect")).nth(1).expect("a frame");
        let bottom = number(frame, "y") + number(frame, "height");
        let right = number(frame, "x") + number(frame, "width");
        for wall in of_class(root, "barrier").descendants() {
            for [x, y] in places(wall) {
                assert!(x >= number(frame, "x") && x <= right && y >= number(frame, "y") && y <= bottom, "[{x}, {y}] leaves the impact");
            }
        }
        drawn += 1;
    }
}

/// Asserts that the panels of a case are framed.
fn assert_framed(text: &str) {
    let case = Case::parse(Source::new("framed.toml", text)).expect("a readable file");
    let svg = scene(&draw(&case, &(), &Uncontrolled).expect("a possible collision"), Units::Si);
    all_panels_are_framed(Document::parse(&svg).expect("well-formed").root_element());
}

/// Beside a long vehicle the pictures have a small scale, and the arrow of a short one is longer than it.
#[test]
fn arrows_of_short_vehicles_are_within_their_frames() {
    assert_framed(
        "schema = 1\n\
         [[vehicle]]\nname = \"bus\"\nmass = 1830\nradius_of_gyration = 1.3\nheading = 0\nspeed = 11.54\nimpact_center = [2.03, -0.26]\n\
         length = 13.03\nwidth = 1.7\n\
         [[vehicle]]\nname = \"car\"\nmass = 1297\nradius_of_gyration = 1.43\nheading = 4.626\nspeed = 17.83\nimpact_center = [1.24, 0.59]\n\
         [contact]\ncrush_plane = -0.456\nrestitution = 0.1\nfriction = 0.7\n",
    );
}

/// The ellipse of a place that is hardly known is larger than the scene.
#[test]
fn ellipses_of_rest_positions_are_within_their_frames() {
    let rest = "position = [{ value = 10.1, sd = 3.0 }, { value = 6.5, sd = 3.5 }]";
    let text = include_str!("../../cli/examples/to-rest.toml");
    let line = text.lines().find(|line| line.starts_with("position")).expect("a rest position");
    assert_framed(&text.replacen(line, rest, 1));
}

#[test]
fn names_neither_break_nor_inject() {
    let hostile =
        ["</text><script>alert(1)</script>", "\\u0007\\u001b[31m\\u202e\\uFFFE", "&#x3c;b&#x3e; ]]> -->", "שלום עולם", &"x".repeat(10_000)];
    for name in hostile {
        for (key, old) in [("name", "name = \"sedan\""), ("title", "title = \"Sedan into the side of a pickup, position A\"")] {
            let (_, svg) = altered(old, &format!("{key} = \"{name}\""));
            let page = Document::parse(&svg).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(page.descendants().all(|node| !node.has_tag_name("script") && !node.has_tag_name("b")));
            no_label_covers_another(page.root_element());
            assert!(svg.len() < 60_000, "{} bytes", svg.len());
            assert!(!svg.contains(|c: char| c.is_control() && c != '\n' || c == '\u{202e}'));
        }
    }
}

#[test]
fn an_impact_center_outside_the_outline_is_said() {
    let size = "name = \"sedan\"\nlength = \"14 ft\"\nwidth = \"5 ft\"";
    let (answer, svg) = altered("name = \"sedan\"", size);
    assert!(answer.notices.0.iter().all(|notice| notice.code != "impact-center-outside") && svg.contains("middle of its length"));
    let (answer, svg) = altered("name = \"sedan\"", &size.replace("14", "10"));
    let warning = answer.notices.0.iter().find(|notice| notice.code == "impact-center-outside").expect("a warning");
    // 6.3499 ft forward of the center of mass, 5 ft in front of it.
    assert_eq!(
        Units::Us.sentence(&warning.message),
        "vehicle.1: its impact center lies 1.35 ft outside its outline; check its signs: forward and left of the center of mass"
    );
    assert!(svg.contains("1.35 ft outside its outline"));
}
