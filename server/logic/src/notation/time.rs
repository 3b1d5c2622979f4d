/// The milliseconds that a time such as `5s`, `1m30s`, `2.5s` or `T#250ms`
/// stands for, rounded to the nearest; `None` for any other text.
///
/// Units are `d`, `h`, `m`, `s` and `ms`. A time too long for 64 bits gives
/// the largest value.
pub fn milliseconds(time: &str) -> Option<u64> {
    let time = time
        .strip_prefix("T#")
        .or_else(|| time.strip_prefix("t#"))
        .unwrap_or(time);
    if time.is_empty() {
        return None;
    }
    let mut total = 0.0;
    let mut rest = time;
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let (number, after) = rest.split_at_checked(digits)?;
        let letters = after
            .find(|c: char| !c.is_ascii_lowercase())
            .unwrap_or(after.len());
        let (unit, next) = after.split_at_checked(letters)?;
        total += number.parse::<f64>().ok()? * unit_in_milliseconds(unit)?;
        rest = next;
    }
    Some(total.round() as u64)
}

/// A number of milliseconds as the notation writes a time: `1m30s`.
pub fn time(milliseconds: u64) -> String {
    let units = [
        ("d", 86_400_000),
        ("h", 3_600_000),
        ("m", 60_000),
        ("s", 1_000),
        ("ms", 1),
    ];
    let mut rest = milliseconds;
    let mut text = String::new();
    for (unit, length) in units {
        let whole = rest / length;
        rest %= length;
        if whole > 0 {
            text.push_str(&format!("{whole}{unit}"));
        }
    }
    if text.is_empty() {
        "0s".to_owned()
    } else {
        text
    }
}

/// The length of a unit, in milliseconds.
pub(crate) fn unit_in_milliseconds(unit: &str) -> Option<f64> {
    Some(match unit {
        "ms" => 1.0,
        "s" => 1_000.0,
        "m" => 60_000.0,
        "h" => 3_600_000.0,
        "d" => 86_400_000.0,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_time_add_up() {
        assert_eq!(milliseconds("5s"), Some(5_000));
        assert_eq!(milliseconds("1m30s"), Some(90_000));
        assert_eq!(milliseconds("T#2.5s"), Some(2_500));
        assert_eq!(milliseconds("1d1h1ms"), Some(90_000_001));
    }

    #[test]
    fn a_time_is_read_as_it_is_written() {
        for (length, written) in [(0, "0s"), (90_000, "1m30s"), (86_400_250, "1d250ms")] {
            assert_eq!(time(length), written);
            assert_eq!(milliseconds(written), Some(length));
        }
    }

    #[test]
    fn what_is_no_time_has_no_milliseconds() {
        for text in ["", "5", "s", "5 s", "5x", "T#", "1.2.3s", "été", "5é"] {
            assert_eq!(milliseconds(text), None, "{text}");
        }
    }
}
