//! Prints the public interface from the JSON of rustdoc, whose path is the argument: one item a line, sorted, without blanket implementations.

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let json = std::env::args_os().nth(1).ok_or("give the path of the JSON of rustdoc")?;
    let interface = public_api::Builder::from_rustdoc_json(json)
        .omit_blanket_impls(true)
        .omit_auto_trait_impls(true)
        .omit_auto_derived_impls(true)
        .build()?;
    let mut lines: Vec<String> = interface.to_string().lines().map(sorted).collect();
    lines.sort();
    lines.iter().for_each(|line| println!("{line}"));
    Ok(())
}

/// Sorts the associated types of `Trait<A = …, B = …>`, whose order in the JSON varies from build to build.
fn sorted(text: &str) -> String {
    let Some(open) = text.find('<') else { return text.to_owned() };
    let (mut depth, mut items, mut start) = (0, Vec::new(), open + 1);
    for (i, letter) in text.char_indices().skip_while(|(i, _)| *i < open) {
        let ends_arrow = letter == '>' && text[..i].ends_with(['-', '=']);
        match letter {
            '<' | '(' | '[' => depth += 1,
            '>' | ')' | ']' if !ends_arrow => depth -= 1,
            ',' if depth == 1 => {
                items.push(sorted(text[start..i].trim()));
                start = i + 1;
            }
            _ => (),
        }
        if depth == 0 {
            items.push(sorted(text[start..i].trim()));
            // Arguments come first, in their own order.
            items.sort_by_key(|item| item.split('<').next().filter(|name| name.contains(" = ")).map(|_| item.clone()));
            return format!("{}{}{}", &text[..=open], items.join(", "), format_args!("{letter}{}", sorted(&text[i + 1..])));
        }
    }
    text.to_owned()
}
