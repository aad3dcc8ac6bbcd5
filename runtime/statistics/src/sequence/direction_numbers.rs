//! Primitive polynomials and initial direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2635-2654, 2008), set
//! new-joe-kuo-6, and the direction numbers derived from them.

use super::scrambling::DIGITS;

/// One line per dimension, from the second on: the coefficients `a` of the polynomial, then `m_1` to `m_s`.
const TABLE: &str = include_str!("joe_kuo_2008.txt");

/// Number of dimensions in the table.
pub(super) const MAX_DIMENSIONS: usize = 2048;

/// Direction numbers of a dimension: binary fractions of [`DIGITS`] digits.
pub(super) type Directions = [u64; DIGITS as usize];

/// Direction numbers of the leading dimensions.
pub(super) fn directions(dimensions: usize) -> Vec<Directions> {
    let mut all = Vec::with_capacity(dimensions);
    all.push(core::array::from_fn(|i| 1 << (DIGITS as usize - 1 - i)));
    all.extend(rows().take(dimensions - 1).map(|(a, m)| extend(a, &m)));
    all
}

/// Polynomial and initial numbers of each dimension, from the second on.
fn rows() -> impl Iterator<Item = (u64, Vec<u64>)> {
    TABLE.lines().map(|line| {
        let mut numbers = line.split_whitespace().flat_map(str::parse);
        (numbers.next().unwrap_or(0), numbers.collect())
    })
}

/// The recurrence of Bratley and Fox (ACM Trans. Math. Softw. 14, 1988, equation 2):
/// `v_i = a_1 v_(i-1) ^ ... ^ a_(s-1) v_(i-s+1) ^ v_(i-s) ^ v_(i-s) / 2^s`.
fn extend(a: u64, m: &[u64]) -> Directions {
    let degree = m.len();
    let mut v = [0; DIGITS as usize];
    for i in 0..v.len() {
        v[i] = if i < degree {
            m[i] << (DIGITS as usize - 1 - i)
        } else {
            let last = v[i - degree];
            let middle = (1..degree).filter(|j| a >> (degree - 1 - j) & 1 == 1);
            middle.fold(last ^ last >> degree, |sum, j| sum ^ v[i - j])
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A power of `x` modulo a polynomial of the given degree over the field with two elements.
    fn power(exponent: u64, polynomial: u64, degree: usize) -> u64 {
        let reduce = |x: u64| {
            if x >> degree & 1 == 1 { x ^ polynomial } else { x }
        };
        let product =
            |a: u64, b: u64| (0..degree).rev().fold(0, |sum, i| reduce(sum << 1) ^ if b >> i & 1 == 1 { a } else { 0 });
        let (mut result, mut square) = (1, reduce(2));
        for i in 0..=degree {
            if exponent >> i & 1 == 1 {
                result = product(result, square);
            }
            square = product(square, square);
        }
        result
    }

    fn prime_factors(mut number: u64) -> Vec<u64> {
        let mut factors = Vec::new();
        let mut divisor = 2;
        while divisor * divisor <= number {
            if number.is_multiple_of(divisor) {
                factors.push(divisor);
                number /= divisor;
            } else {
                divisor += 1;
            }
        }
        factors.extend((number > 1).then_some(number));
        factors
    }

    fn is_primitive(polynomial: u64, degree: usize) -> bool {
        let order = (1_u64 << degree) - 1;
        let smaller = |p: &u64| power(order / p, polynomial, degree) == 1;
        power(order, polynomial, degree) == 1 && !prime_factors(order).iter().any(smaller)
    }

    /// The polynomials are all the primitive ones, in order of degree and coefficients; found here independently.
    #[test]
    fn polynomials_are_the_primitive_ones_in_order() {
        let primitive = (1..)
            .flat_map(|degree| (0..1_u64 << (degree - 1)).map(move |a| (degree, a)))
            .filter(|&(degree, a)| is_primitive(1 << degree | a << 1 | 1, degree));
        let table = rows().map(|(a, m)| (m.len(), a));
        assert!(primitive.take(MAX_DIMENSIONS - 1).eq(table));
    }

    #[test]
    fn initial_numbers_are_odd_and_small() {
        for (_, m) in rows() {
            let fits = |(i, m): (usize, &u64)| m % 2 == 1 && *m < 2 << i;
            assert!(m.iter().enumerate().all(fits));
        }
    }

    /// Sobol's property A holds up to dimension 1111 (Joe and Kuo 2008): for every `d`, the first digits of the first
    /// `d` direction numbers of the first `d` dimensions form a regular matrix over the field with two elements. A
    /// wrong digit in the table breaks this with a probability of one half.
    #[test]
    fn property_a_holds_up_to_dimension_1111() {
        const DIMENSIONS: usize = 1111;
        const WORDS: usize = DIMENSIONS.div_ceil(64);
        let digit = |row: &[u64; WORDS], i: usize| row[i / 64] >> (i % 64) & 1;
        let mut matrix = vec![[0; WORDS]; DIMENSIONS];
        matrix[0][0] = 1;
        for (row, (a, m)) in matrix[1..].iter_mut().zip(rows()) {
            let degree = m.len();
            for i in 0..DIMENSIONS {
                let first = if i < degree {
                    m[i] >> i & 1
                } else {
                    let middle = (1..degree).filter(|j| a >> (degree - 1 - j) & 1 == 1);
                    middle.fold(digit(row, i - degree), |sum, j| sum ^ digit(row, i - j))
                };
                row[i / 64] |= first << (i % 64);
            }
        }
        for d in 0..DIMENSIONS {
            let (above, below) = matrix.split_at_mut(d + 1);
            let pivot = &above[d];
            assert_eq!(digit(pivot, d), 1, "dimension {}", d + 1);
            for row in below.iter_mut().filter(|row| digit(row, d) == 1) {
                row.iter_mut().zip(pivot).for_each(|(row, pivot)| *row ^= pivot);
            }
        }
    }
}
