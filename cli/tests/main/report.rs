//! Reports: whole, self-contained, the same bytes each time, and with the case inside.

use std::fs;

use serde_json::Value;

use crate::process::{run, run_with_input, workspace};

/// Returns the report of an example.
fn report(case: &str, arguments: &[&str]) -> String {
    let path = format!("cli/examples/{case}");
    let run = run(&workspace(), &[&["report", &path], arguments].concat());
    assert!(run.status == 0 && run.err.is_empty(), "{case} {arguments:?}: {}", run.err);
    run.out
}

/// Returns the case file that a report has inside.
fn embedded(html: &str) -> String {
    let start = html.find("id=\"case\">").expect("an embedded case") + "id=\"case\">".len();
    let text = &html[start..start + html[start..].find("</script>").expect("the end of the case")];
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
}

/// Returns the section with an address.
fn section<'a>(html: &'a str, id: &str) -> &'a str {
    let start = html.find(&format!("<section id=\"{id}\"")).unwrap_or_else(|| panic!("no section {id}"));
    &html[start..start + html[start..].find("</section>").expect("its end")]
}

#[test]
fn every_input_can_be_entered_again_from_the_report_alone() {
    for case in ["position-a.toml", "sideswipe.toml", "slide.toml", "cavalier-crush.toml", "crabbed-barrier.toml"] {
        let html = report(case, &[]);
        let file = fs::read_to_string(workspace().join("cli/examples").join(case)).expect("the example");
        assert_eq!(embedded(&html), file, "{case}");
        let again = run_with_input(&["solve", "-", "--format", "json"], &embedded(&html));
        let first = run(&workspace(), &["solve", &format!("cli/examples/{case}"), "--format", "json"]);
        assert_eq!(again.out, first.out, "{case}");
    }
}

#[test]
fn files_that_a_case_names_are_in_its_report() {
    let html = report("reconstruct/from-tests.toml", &[]);
    let decoded = |text: &str| text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    let folder = tempfile::tempdir().expect("a folder");
    let below = folder.path().join("reconstruct");
    fs::create_dir(&below).expect("a folder");
    fs::write(below.join("case.toml"), embedded(&html)).expect("written");
    let mut count = 0;
    for file in html.split(" data-name=\"").skip(1) {
        let (name, rest) = file.split_once("\">").expect("a name");
        let path = below.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, decoded(rest.split("</script>").next().expect("a text"))).expect("written");
        count += 1;
    }
    assert!(count > 0);
    let again = run(folder.path(), &["reconstruct", "reconstruct/case.toml", "--format", "json"]);
    let first = run(&workspace(), &["reconstruct", "cli/examples/reconstruct/from-tests.toml", "--format", "json"]);
    assert_eq!((again.status, again.out), (first.status, first.out), "{}", again.err);
}

/// Of the committed report; `UPDATE_REPORT=1` writes it anew.
#[test]
fn the_report_of_two_cars_has_the_same_bytes_everywhere() {
    let path = workspace().join("docs/two-cars.html");
    let html = report("reconstruct/two-cars.toml", &[]);
    if std::env::var_os("UPDATE_REPORT").is_some() {
        fs::write(&path, &html).expect("written");
    }
    let golden = fs::read_to_string(&path).expect("the committed report");
    let differing = html.lines().zip(golden.lines()).position(|(now, then)| now != then);
    assert!(html == golden, "differs from docs/two-cars.html at line {differing:?}; UPDATE_REPORT=1 writes it anew");
    assert!(html.len() < 500_000, "{} bytes", html.len());
    // The answer stands in the summary, and is that of `reconstruct`.
    let summary = section(&html, "summary");
    assert!(summary.contains("vehicle.1.speed (sedan): 52.4 km/h, 95 % from 49.7 to 55.1."), "{summary}"); // 52.4 ± 1.4 km/h in the README
    assert!(section(&html, "question").contains("rest.vehicle.1.position.1") && section(&html, "scene").contains("<svg"));
}

/// The picture of the README is what the program draws; `UPDATE_REPORT=1` writes it anew.
#[test]
fn the_picture_of_the_readme_is_up_to_date() {
    let path = workspace().join("docs/position-a.svg");
    let call = ["sweep", "cli/examples/position-a.toml", "--vary", "Gamma=-10deg:10deg:1deg", "--of", "W_n,W_t,mu0", "--format", "svg"];
    let drawn = run(&workspace(), &call).out;
    if std::env::var_os("UPDATE_REPORT").is_some() {
        fs::write(&path, &drawn).expect("written");
    }
    assert!(
        drawn == fs::read_to_string(&path).expect("the committed picture"),
        "docs/position-a.svg is stale; UPDATE_REPORT=1 writes it anew"
    );
}

#[test]
fn nothing_comes_from_elsewhere_and_no_script_is_needed() {
    for (case, verb) in [
        ("position-a.toml", "solve"),
        ("cavalier-crush.toml", "crush"),
        ("cavalier-crush.toml", "crash3"),
        ("uncertain.toml", "uncertainty"),
    ] {
        let html = report(case, &["--verb", verb]);
        for address in html.match_indices("://").map(|(at, _)| &html[at.saturating_sub(5)..(at + 40).min(html.len())]) {
            assert!(
                address.contains("www.w3.org") || address.contains("json-schema") || embedded(&html).contains(address.trim_matches('"')),
                "{address}"
            );
        }
        let elements = ["<link", "<img", "<iframe", "@import", "url(", "<object", "javascript:", " on"];
        let outside = html.replace(section(&html, "input"), "");
        let outside = &outside[..outside.find("<script").unwrap_or(outside.len())];
        for element in &elements[..7] {
            assert!(!outside.contains(element), "{verb} has {element}");
        }
        assert_eq!(html.matches("<script").count(), 1, "{verb}: the case alone");
        assert!(html.len() < 500_000);
    }
}

#[test]
fn a_report_names_what_it_stands_on() {
    let html = report("position-a.toml", &["--date", "3 May <2026>"]);
    let sections = ["summary", "scene", "question", "method", "results", "sensitivity", "alternatives", "validation", "input", "glossary"];
    let places: Vec<usize> =
        sections.iter().map(|id| html.find(&format!("<section id=\"{id}\"")).unwrap_or_else(|| panic!("{id}"))).collect();
    assert!(places.is_sorted());
    assert!(section(&html, "summary").contains("3 May &lt;2026&gt;"));
    // sha256sum of the file.
    let digits = "ea320a26aee0d1335e683e6b381fb5638c344b32480cf35c3d18091167918e85";
    assert!(section(&html, "summary").contains(digits), "{}", section(&html, "summary"));
    // The same of the file with a byte order mark, which the embedded one keeps.
    let marked = format!("\u{feff}{}", fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example"));
    let of_marked = run_with_input(&["report", "-"], &marked).out;
    assert!(
        section(&of_marked, "summary").contains("0290618c9b7a887873cf4d64ce02564c0005e5a042322cab83d803e2811f6c06")
            && embedded(&of_marked) == marked
    );
    assert!(section(&html, "method").contains("<math") && section(&html, "method").contains("<mfrac>"));
    assert!(section(&html, "alternatives").contains("law of Kudlich-Slibar"));
    assert!(section(&html, "results").matches("<figure>").count() == 2 && section(&html, "sensitivity").contains("<figure>"));
    // 40 ft/s are 27.3 mph, and the ΔV of the paper's sedan is 15.4 mph.
    assert!(
        section(&html, "summary").contains("sedan: ΔV 15.4 mph")
            && section(&html, "question").contains("<td class=\"number\">40</td><td>ft/s</td>")
    );
    assert!(!report("position-a.toml", &[]).contains("Date"));
    // Notices are part of the answer.
    let text = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example");
    let bare = run_with_input(&["report", "-"], &text.replace("\"90 deg\"", "1.5707963267948966"));
    assert!(section(&bare.out, "results").contains("<strong>Note:</strong> vehicle.2.heading has no unit"), "{}", bare.err);
}

#[test]
fn sections_and_units_are_as_asked() {
    let html = report("position-a.toml", &["--sections", "summary,input", "--units", "si"]);
    assert_eq!(html.matches("<section").count(), 2);
    assert!(section(&html, "summary").contains("sedan: ΔV 24.9 km/h")); // 15.45 mph
    let refused = run(&workspace(), &["report", "cli/examples/position-a.toml", "--sections", "sumary"]);
    assert!(refused.status == 2 && refused.out.is_empty() && refused.err.contains("summary"), "{}", refused.err);
    // Nothing of a crush energy depends on a scene, and a report without what was asked for would be empty.
    let without = ["report", "cli/examples/cavalier-crush.toml", "--verb", "crush", "--sections", "results,sensitivity"];
    let refused = run(&workspace(), &without);
    assert!(refused.status == 2 && refused.out.is_empty(), "{}", refused.out);
    assert!(refused.err.contains("--sections: it has no effect: this report has nothing to say on sensitivity"), "{}", refused.err);
    assert!(refused.err.contains("leave out sensitivity"), "{}", refused.err);
}

#[test]
fn a_reconstruction_has_its_profile_and_on_request_its_posterior() {
    let [plain, with] = [&[][..], &["--posterior"]].map(|asked| report("reconstruct/crabbed-2.toml", asked));
    for (html, is_drawn) in [(&plain, false), (&with, true)] {
        let results = section(html, "results");
        assert!(results.contains("<figcaption>The profile of the likelihood"), "profiles are drawn");
        assert_eq!(results.contains("<figcaption>The posterior of the unknowns"), is_drawn);
        assert_eq!(results.contains("chains of"), is_drawn, "the page has the numbers of what is drawn");
    }
}

#[test]
fn the_posterior_is_refused_where_nothing_is_reconstructed() {
    for call in [
        &["report", "cli/examples/position-a.toml", "--posterior"][..],
        &["report", "cli/examples/uncertain.toml", "--verb", "uncertainty", "--posterior"],
        &["report", "--verb", "validate", "--posterior"],
    ] {
        let run = run(&workspace(), call);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{call:?}");
        assert!(run.err.contains("--posterior: it has no effect") && run.err.contains("--verb reconstruct"), "{}", run.err);
    }
}

#[test]
fn units_are_refused_where_a_report_has_its_own() {
    for call in [&["report", "--verb", "validate", "--units", "si"][..], &["report", "x.json", "--verb", "check", "--units", "us"]] {
        let run = run(&workspace(), call);
        assert!(run.status == 2 && run.out.is_empty() && run.err.contains("--units has no effect"), "{}", run.err);
    }
}

#[test]
fn a_file_appears_only_when_it_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, case) = (folder.path().join("report.html"), workspace().join("cli/examples/position-a.toml"));
    let written = run(folder.path(), &["report", case.to_str().expect("a path"), "-o", "report.html"]);
    assert!(written.status == 0 && written.out.is_empty() && written.err.is_empty(), "{}", written.err);
    assert!(fs::read_to_string(&file).expect("written").ends_with("</html>\n"));
    fs::remove_file(&file).expect("removed");
    let text = fs::read_to_string(case).expect("the example").replace("40 ft/s", "-40 ft/s");
    let refused = run_with_input(&["report", "-", "-o", file.to_str().expect("a path")], &text);
    assert!(refused.status == 3 && !file.exists(), "{} {}", refused.status, refused.err);
    let nowhere =
        run(folder.path(), &["draw", workspace().join("cli/examples/position-a.toml").to_str().expect("a path"), "-o", "none/scene.svg"]);
    assert!(
        nowhere.status == 74 && nowhere.err.contains("cannot be written: ") && !nowhere.err.contains(".planar-impact-"),
        "{}",
        nowhere.err
    );
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 0);
}

/// As `reconstruct` and `compare` do.
#[test]
fn a_report_of_no_unique_answer_has_its_status() {
    let contradicted = run(&workspace(), &["report", "cli/tests/reproducers/momentum_alone.toml"]);
    assert!(contradicted.status == 1 && contradicted.out.ends_with("</html>\n"), "{}", contradicted.err);
}

#[test]
fn tests_records_and_the_validation_have_reports_too() {
    let stiffness = report("tests/malibu.toml", &["--verb", "stiffness"]);
    let file = fs::read_to_string(workspace().join("cli/examples/tests/malibu.toml")).expect("the example");
    assert_eq!(embedded(&stiffness), file);
    assert!(section(&stiffness, "results").contains("<svg") && section(&stiffness, "summary").contains("A = 78283 N/m"));
    // Many records, of which each breaks a law: momentum of vehicle 1 from 10 to 5 m/s, and none of vehicle 2.
    let folder = tempfile::tempdir().expect("a folder");
    let head = "id,b1.mass,b2.mass,b1.before.vx,b1.before.vy,b1.after.vx,b1.after.vy,b2.before.vx,b2.before.vy,b2.after.vx,b2.after.vy\n,kg,kg,m/s,m/s,m/s,m/s,m/s,m/s,m/s,m/s\n";
    let records: String = (0..3000).map(|k| format!("<b>{k}</b>,1000,1500,10,0,5,0,0,0,0,0\n")).collect();
    fs::write(folder.path().join("records.csv"), head.to_owned() + &records).expect("written");
    let checked = run(folder.path(), &["report", "records.csv", "--verb", "check"]);
    assert_eq!(checked.status, 1, "{}", checked.err);
    assert!(section(&checked.out, "summary").contains("3000 of 3000 records break a law."));
    assert!(section(&checked.out, "results").contains("linear-momentum (fail): 3000, of which the first 20"));
    assert!(checked.out.contains("&lt;b&gt;0&lt;/b&gt;") && checked.out.len() < 40_000, "{} bytes", checked.out.len());
    let validation = run(&workspace(), &["report", "--verb", "validate"]);
    assert_eq!(validation.status, 0);
    assert!(section(&validation.out, "results").contains("Table B2"));
    for (arguments, why) in [
        (&["report"][..], "give one file"),
        (&["report", "a", "b"], "give one file"),
        (&["report", "--verb", "check"], "one file of records or more"),
        (&["report", "a", "--verb", "validate"], "takes no file"),
        (&["report", "cli/examples/position-a.toml", "--verb", "crush"], "crush"),
    ] {
        let refused = run(&workspace(), arguments);
        assert!(refused.status == 2 && refused.out.is_empty() && refused.err.contains(why), "{arguments:?}: {}", refused.err);
    }
}

#[test]
fn hostile_names_stay_names() {
    let text = fs::read_to_string(workspace().join("cli/examples/position-a.toml")).expect("the example");
    let mut case: Value = toml::from_str(&text).expect("TOML");
    for bad in ["</script><script>alert(1)</script><!--", "\u{202e}abc\u{7}\u{1b}[2J", "]]>\u{0}&#60;b>", &"ש".repeat(10_000)] {
        for path in ["/title", "/vehicle/0/name"] {
            *case.pointer_mut(path).expect("the key") = bad.into();
        }
        let made = run_with_input(&["report", "-"], &case.to_string());
        assert_eq!(made.status, 0, "{}", made.err);
        let html = made.out;
        assert_eq!(html.matches("<script").count(), 1);
        let shown = &html[..html.find("<script").expect("the case")];
        assert!(shown.chars().all(|c| c == '\n' || !c.is_control() && c != '\u{202e}'), "{bad:?}");
        let again: Value = serde_json::from_str(&embedded(&html)).expect("the case");
        assert_eq!(again["title"], bad);
    }
}

/// What the method says is true of the case: its bodies, its moment impulse, and its law.
#[test]
fn the_method_is_that_of_the_case() {
    let two = "[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = \"180 deg\"\nspeed = 9.3\nimpact_center = [1.8, 0.3]\n";
    let case = |second: &str, contact: &str| {
        format!(
            "schema = 1\n[[vehicle]]\nmass = 1422.2\nyaw_inertia = 2000\nheading = 0\nspeed = 13.7\nimpact_center = [1.9, 0.5]\n{second}[contact]\n\
             crush_plane = \"20 deg\"\nrestitution = 0.2\n{contact}"
        )
    };
    let of = |second: &str, contact: &str| {
        let run = run_with_input(&["report", "-", "--sections", "method"], &case(second, contact));
        assert_eq!(run.status, 0, "{contact}: {}", run.err);
        section(&run.out, "method").to_owned()
    };
    let [conserved, ends, moment] =
        ["Momentum and angular momentum are conserved", "Sliding at the impact center ends", "moment impulse of the file"];
    let usual = of(two, "");
    assert!(usual.contains(conserved) && usual.contains(ends) && !usual.contains(moment) && !usual.contains("barrier"), "{usual}");
    let wall = of("[[vehicle]]\nbarrier = true\n", "");
    assert!(wall.contains("a rigid body and a fixed barrier exchange one impulse") && !wall.contains(conserved), "{wall}");
    let turned = of(two, "moment = \"-200 N m s\"\n");
    assert!(turned.contains(moment) && turned.contains("one impulse at a common point, and a moment impulse"), "{turned}");
    let reversed = of(two, "tangential_law = \"kudlich-slibar\"\n");
    assert!(!reversed.contains(ends) && reversed.contains("is reversed before the vehicles separate"), "{reversed}");
    assert!(!reversed.contains("mu0 at which sliding ends"), "{reversed}");
    for (friction, is, kind) in [
        ("0.9", "Here it is the limit.", "(critical, less than friction 0.900)"),
        ("0.05", "Here it is the friction: the vehicles still slide", "(limited by friction 0.050)"),
    ] {
        let limited = of(two, &format!("friction = {friction}\n"));
        assert!(limited.contains(is), "{friction}: {limited}");
        let results = run_with_input(&["solve", "-"], &case(two, &format!("friction = {friction}\n"))).out;
        assert!(results.contains(kind), "{friction}: {results}");
    }
}

/// A loss, a share or an effect that is rounding is zero.
#[test]
fn rounding_is_no_loss() {
    let case = "schema = 1\n[[vehicle]]\nmass = 1500\nyaw_inertia = 2500\nheading = 0\nspeed = 13.7\nimpact_center = [1.9, 0]\n[[vehicle]]\nmass = 1422.2\n\
                yaw_inertia = 2000\nheading = \"180 deg\"\nspeed = 9.3\nimpact_center = [1.8, 0]\n[contact]\ncrush_plane = 0\nrestitution = 1\n";
    let solved = run_with_input(&["solve", "-"], case);
    assert!(solved.out.contains("Energy lost: 0 J, 0 % of what there was.") && !solved.out.contains("-0"), "{}", solved.out);
    let html = run_with_input(&["report", "-", "--sections", "summary,results,sensitivity"], case);
    assert!(html.status == 0 && !html.out.contains("e-1") && !html.out.contains("-0.0 %"), "{}", html.out);
}

/// `±` is a normal distribution: another shape has its limits, or is named a standard deviation.
#[test]
fn an_input_that_is_not_normal_is_not_shown_as_one() {
    let html = report("uncertain.toml", &["--verb", "solve"]);
    let question = section(&html, "question");
    for [name, value] in [["contact.restitution", "0.1, 0 to 0.3"], ["vehicle.2.speed", "11.3889, 10 to 12.7778"]] {
        let row = question.lines().find(|line| line.contains(name)).unwrap_or_else(|| panic!("{name}: {question}"));
        assert!(row.contains(value) && !row.contains('±'), "{row}");
    }
    let normal = question.lines().find(|line| line.contains("vehicle.1.mass")).expect("a mass");
    assert!(normal.contains(" ± "), "{normal}");
}
