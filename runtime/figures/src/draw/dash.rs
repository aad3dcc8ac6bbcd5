//! Dashes along a line. plotters supports only a single dash and gap length.

type Pixel = (i32, i32);

/// The dashes of a line; `pattern` alternates dash and gap lengths.
pub(super) fn dashes(line: &[Pixel], pattern: &[f64]) -> Vec<Vec<Pixel>> {
    let mut dashes = Vec::new();
    let Some(&first) = line.first() else {
        return dashes;
    };
    let whole: f64 = pattern.iter().sum();
    if whole <= 0.0 {
        return vec![line.to_vec()];
    }
    let (mut turn, mut left) = (0, pattern[0]);
    let mut dash = vec![first];
    for pair in line.windows(2) {
        let [(x, y), (to_x, to_y)] = [pair[0], pair[1]].map(|(x, y)| (f64::from(x), f64::from(y)));
        let length = (to_x - x).hypot(to_y - y);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let t = done / length;
            let at = ((x + t * (to_x - x)).round() as i32, (y + t * (to_y - y)).round() as i32);
            if turn % 2 == 0 {
                dash.push(at);
                dashes.push(std::mem::take(&mut dash));
            } else {
                dash = vec![at];
            }
            turn = (turn + 1) % pattern.len();
            left = pattern[turn];
        }
        left -= length - done;
        if turn % 2 == 0 {
            dash.push(pair[1]);
        }
    }
    if dash.len() > 1 {
        dashes.push(dash);
    }
    dashes
}

#[cfg(test)]
mod tests {
    use super::dashes;

    #[test]
    fn dashes_go_round_corners() {
        let line = [(0, 0), (10, 0), (10, 10)];
        let pixels = dashes(&line, &[6.0, 3.0]);
        let expected = [vec![(0, 0), (6, 0)], vec![(9, 0), (10, 0), (10, 5)], vec![(10, 8), (10, 10)]];
        assert_eq!(pixels, expected);
        assert!(dashes(&[], &[6.0, 3.0]).is_empty());
    }
}
