package io.furrow.launcher.status;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** What a terminal shows after what was written to it; knows the sequences that are needed here. */
final class Screen {
    private static final Pattern PART = Pattern.compile("\033\\[([?]?[\\d;]*)([A-Za-z])|(\r|\n|\b)|([^\033\r\n\b])");

    private final char[][] cells;
    private final List<String> scrolledAway = new ArrayList<>();
    private int row;
    private int column;

    Screen(int columns, int rows) {
        cells = new char[rows][columns];
        clear(0);
    }

    Screen write(String text) {
        Matcher part = PART.matcher(text);
        while (part.find()) {
            if (part.group(4) != null) {
                print(part.group(4).charAt(0));
            } else if (part.group(3) != null) {
                switch (part.group(3)) {
                    case "\r" -> column = 0;
                    case "\b" -> column = Math.max(0, column - 1);
                    default -> down();
                }
            } else {
                control(part.group(2).charAt(0), part.group(1).split(";"));
            }
        }
        return this;
    }

    private void print(char sign) {
        if (column == cells[0].length) {
            column = 0;
            down();
        }
        cells[row][column++] = sign;
    }

    private void control(char command, String[] numbers) {
        int number = numbers[0].matches("\\d+") ? Integer.parseInt(numbers[0]) : 1;
        switch (command) {
            case 'A' -> row = Math.max(0, row - number);
            case 'B' -> row = Math.min(cells.length - 1, row + number);
            case 'C' -> column = Math.min(cells[0].length - 1, column + number);
            case 'D' -> column = Math.max(0, column - number);
            case 'H' -> {
                row = number - 1;
                column = numbers.length > 1 ? Integer.parseInt(numbers[1]) - 1 : 0;
            }
            case 'J' -> clear(numbers[0].equals("2") ? 0 : row);
            case 'L' -> shift(number);
            case 'M' -> shift(-number);
            case 'K' -> Arrays.fill(cells[row], column, cells[row].length, ' ');
            default -> {}
        }
    }

    private void clear(int from) {
        for (int i = from; i < cells.length; i++) {
            Arrays.fill(cells[i], ' ');
        }
    }

    /** @param lines inserted at the cursor, or deleted if less than 0 */
    private void shift(int lines) {
        List<char[]> below = new ArrayList<>(Arrays.asList(cells).subList(row, cells.length));
        int height = below.size();
        for (int i = 0; i < Math.abs(lines); i++) {
            char[] blank = new char[cells[0].length];
            Arrays.fill(blank, ' ');
            below.remove(lines > 0 ? height - 1 : 0);
            below.add(lines > 0 ? 0 : height - 1, blank);
        }
        for (int i = 0; i < height; i++) {
            cells[row + i] = below.get(i);
        }
    }

    private void down() {
        if (row < cells.length - 1) {
            row++;
            return;
        }
        scrolledAway.add(new String(cells[0]));
        for (int i = 1; i < cells.length; i++) {
            cells[i - 1] = cells[i].clone();
        }
        Arrays.fill(cells[row], ' ');
    }

    /** Its rows, without blanks at their ends. */
    List<String> rows() {
        return Arrays.stream(cells).map(row -> new String(row).stripTrailing()).toList();
    }

    List<String> scrolledAway() {
        return scrolledAway;
    }
}
