//! Answers of random cases for the tests of figures, and a reader of what a figure writes.

use planar_impact_app::reconstruct::{Options, Reconstruction, reconstruct};
use planar_impact_app::solve::{Solution, solve};
use planar_impact_app::{Answer, Case, Source, Uncontrolled};

/// Numbers from 0 to 1 that look random, the same in each run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Returns a number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        // Xorshift (Marsaglia 2003).
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

pub fn case(text: &str) -> Case {
    let source = Source::new("case", text);
    Case::parse(source).unwrap_or_else(|issues| panic!("{issues}\n{text}"))
}

pub fn solved(text: &str) -> Option<Answer<Solution>> {
    solve(&case(text), &(), &Uncontrolled).ok()
}

/// Reconstructs a case from few starts.
pub fn reconstructed(text: &str, options: Options) -> Answer<Reconstruction> {
    reconstruct(&case(text), &Options { starts: 4, ..options }, &Uncontrolled).expect("an answer")
}

/// A random case, and its mirror image in the x axis.
pub fn pair(random: &mut Random) -> [String; 2] {
    let mut number = |low, high| random.between(low, high);
    let vehicle = [0, 1].map(|_| {
        [
            number(600.0, 20_000.0),
            number(0.8, 2.5),
            number(-3.1, 3.1),
            number(-20.0, 20.0),
            number(-20.0, 20.0),
            number(-3.0, 3.0),
            number(-2.5, 2.5),
            number(-1.0, 1.0),
        ]
    });
    let (plane, restitution) = (number(-3.1, 3.1), if number(0.0, 1.0) < 0.2 { 0.0 } else { number(0.0, 0.5) });
    let (kind, size, barrier, law, share) = (number(0.0, 4.0), number(0.0, 0.8), number(0.0, 1.0), number(0.0, 1.0), number(0.0, 1.0));
    let of_sign = |sign: f64| {
        let vehicles: Vec<String> = vehicle
            .iter()
            .enumerate()
            .map(|(i, [mass, radius, heading, vx, vy, rate, forward, left])| {
                if i == 1 && barrier < 0.2 {
                    return "[[vehicle]]\nname = \"wall\"\nbarrier = true\n".to_owned();
                }
                format!(
                    "[[vehicle]]\nname = \"car\"\nmass = {mass:?}\nradius_of_gyration = \"{radius} m\"\nheading = \"{} rad\"\nvelocity = [{vx:?}, {:?}]\n\
                     yaw_rate = \"{} rad/s\"\nimpact_center = [{forward:?}, {:?}]\n",
                    sign * heading,
                    sign * vy,
                    sign * rate,
                    sign * left
                )
            })
            .collect();
        let ratio = match kind {
            kind if kind < 1.0 => String::new(),
            kind if kind < 2.0 => format!("impulse_ratio = {{ of_critical = {share:?} }}\n"),
            kind if kind < 3.0 => format!("friction = {size:?}\n"),
            _ => "moment = { of_critical = 0.5 }\n".to_owned(),
        };
        let law = if law < 0.7 { "brach" } else { "kudlich-slibar" };
        format!(
            "schema = 1\n{}[contact]\ncrush_plane = \"{} rad\"\nrestitution = {restitution:?}\ntangential_law = \"{law}\"\n{ratio}",
            vehicles.concat(),
            sign * plane
        )
    };
    [of_sign(1.0), of_sign(-1.0)]
}

/// Returns solved random cases, each with its mirror image.
pub fn pairs(count: usize) -> Vec<[Answer<Solution>; 2]> {
    let mut random = Random::new(1);
    let mut found = Vec::new();
    while found.len() < count {
        let [one, other] = pair(&mut random);
        if let (Some(one), Some(other)) = (solved(&one), solved(&other)) {
            found.push([one, other]);
        }
    }
    found
}

/// A text of a figure: its words, its size and the box that it covers, in pixels.
#[derive(Debug)]
pub struct Written {
    pub words: String,
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// Reads the texts of a figure, but those that run upwards.
pub fn texts(svg: &str) -> Vec<Written> {
    let attribute = |tag: &str, name: &str| -> Option<String> {
        let rest = tag.split_once(&format!(" {name}=\""))?.1;
        Some(rest.split_once('"')?.0.to_owned())
    };
    let read = |part: &str| {
        let (tag, rest) = part.split_once('>')?;
        let words = rest.split_once("</text>")?.0.trim().replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
        let number = |name: &str| attribute(tag, name)?.parse::<f64>().ok();
        if attribute(tag, "transform").is_some() {
            return None;
        }
        // Eight units are a pixel; a letter is about half as wide as it is high.
        let (x, y, size) = (number("x")? / 8.0, number("y")? / 8.0, number("font-size")? / 8.0);
        let wide = 0.56 * size * words.chars().count() as f64;
        let left = match attribute(tag, "text-anchor").as_deref() {
            Some("end") => x - wide,
            Some("middle") => x - wide / 2.0,
            _ => x,
        };
        let top = match attribute(tag, "dy").as_deref() {
            Some("0.76em") => y,
            Some("0.5ex") => y - 0.4 * size,
            _ => y - 0.8 * size,
        };
        Some(Written { words, x: [left, left + wide], y: [top, top + 0.8 * size] })
    };
    svg.split("<text").skip(1).filter_map(read).collect()
}

/// Reads the width or the height of a figure.
pub fn size(svg: &str, name: &str) -> f64 {
    let (root, _) = svg.split_once('>').expect("a root");
    root.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split_once('"')).expect(name).0.parse().expect(name)
}

/// Asserts that a figure is well formed and names itself, that its texts are within it, and that none covers another.
#[track_caller]
pub fn assert_legible(svg: &str) {
    let (root, rest) = svg.split_once('>').expect("a root");
    assert!(root.starts_with("<svg ") && root.contains("role=\"img\"") && svg.trim_end().ends_with("</svg>"), "{root}");
    assert!(rest.trim_start().starts_with("<title>") && rest.contains("</title>\n<desc>"), "a title and a description come first");
    for word in ["NaN", "inf\"", "\u{fffe}", "<script"] {
        assert!(!svg.contains(word), "{word}");
    }
    assert!(!svg.contains(|c: char| c != '\n' && planar_impact_app::plain_text::is_active(c)), "an active character");
    let (width, height) = (size(svg, "width"), size(svg, "height"));
    let texts = texts(svg);
    for (i, one) in texts.iter().enumerate() {
        assert!(!one.words.is_empty(), "nothing is written at {one:?}");
        assert!(
            one.x[0] >= -1.0 && one.x[1] <= width + 1.0 && one.y[0] >= -1.0 && one.y[1] <= height + 1.0,
            "clipped: {one:?} in {width} x {height}"
        );
        for other in &texts[..i] {
            let apart = |one: [f64; 2], other: [f64; 2]| one[1] <= other[0] + 1.0 || other[1] <= one[0] + 1.0;
            assert!(apart(one.x, other.x) || apart(one.y, other.y), "one covers the other: {one:?} {other:?}");
        }
    }
}

/// A name that tries everything: markup, control characters, a mark that turns the text, and length.
pub fn hostile() -> String {
    format!("</text><script>alert(1)</script>&amp;\u{1}\u{202e}\u{fffe}]]>{}", "x".repeat(10_000))
}
