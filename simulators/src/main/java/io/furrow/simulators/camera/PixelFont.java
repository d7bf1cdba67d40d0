package io.furrow.simulators.camera;

import java.awt.image.BufferedImage;
import java.util.Map;

/** Letters of 3 × 5 dots, each dot 2 × 2 pixels: capitals, digits and {@code : - . / _}; anything else is a blank. */
final class PixelFont {
    private static final int DOT = 2;
    private static final int ADVANCE = 4 * DOT;

    /** Five rows of three dots as octal digits: 7 is a full row, 4 its left dot. */
    private static final Map<Character, Integer> GLYPHS = Map.ofEntries(
            Map.entry('0', 075557),
            Map.entry('1', 026227),
            Map.entry('2', 071747),
            Map.entry('3', 071717),
            Map.entry('4', 055711),
            Map.entry('5', 074717),
            Map.entry('6', 074757),
            Map.entry('7', 071222),
            Map.entry('8', 075757),
            Map.entry('9', 075717),
            Map.entry('A', 025755),
            Map.entry('B', 065656),
            Map.entry('C', 034443),
            Map.entry('D', 065556),
            Map.entry('E', 074647),
            Map.entry('F', 074644),
            Map.entry('G', 034553),
            Map.entry('H', 055755),
            Map.entry('I', 072227),
            Map.entry('J', 011152),
            Map.entry('K', 055655),
            Map.entry('L', 044447),
            Map.entry('M', 057755),
            Map.entry('N', 065555),
            Map.entry('O', 025552),
            Map.entry('P', 065644),
            Map.entry('Q', 025563),
            Map.entry('R', 065655),
            Map.entry('S', 034216),
            Map.entry('T', 072222),
            Map.entry('U', 055557),
            Map.entry('V', 055552),
            Map.entry('W', 055775),
            Map.entry('X', 055255),
            Map.entry('Y', 055222),
            Map.entry('Z', 071247),
            Map.entry(':', 002020),
            Map.entry('-', 000700),
            Map.entry('.', 000002),
            Map.entry('/', 011244),
            Map.entry('_', 000007));

    private PixelFont() {}

    /** Writes the text with its upper left corner at x, y; what does not fit to the right is cut. */
    static void write(BufferedImage image, String text, int x, int y, int rgb) {
        for (int i = 0; i < text.length(); i++) {
            int glyph = GLYPHS.getOrDefault(text.charAt(i), 0);
            for (int bit = 0; bit < 15; bit++) {
                if ((glyph >> (14 - bit) & 1) == 1) {
                    dot(image, x + i * ADVANCE + bit % 3 * DOT, y + bit / 3 * DOT, rgb);
                }
            }
        }
    }

    private static void dot(BufferedImage image, int left, int top, int rgb) {
        for (int y = top; y < Math.min(top + DOT, image.getHeight()); y++) {
            for (int x = left; x < Math.min(left + DOT, image.getWidth()); x++) {
                image.setRGB(x, y, rgb);
            }
        }
    }
}
