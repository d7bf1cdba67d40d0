package io.furrow.soak;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * A kind of bad record, defined by a line of {@code bad-records.txt}.
 *
 * @param kind describes the fault
 * @param reason expected in the dead letter
 * @param value null for none
 */
record BadRecord(String kind, String topic, String reason, byte[] key, byte[] value) {
    private static final Pattern REPEATED = Pattern.compile("\\{(\\d+) of (.)}");

    static List<BadRecord> all() {
        try (InputStream lines = BadRecord.class.getResourceAsStream("bad-records.txt")) {
            return new String(lines.readAllBytes(), UTF_8)
                    .lines()
                    .filter(line -> !line.startsWith("#"))
                    .map(BadRecord::of)
                    .toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static BadRecord of(String line) {
        String[] parts = line.split("\\|", 4);
        String value = parts[3].strip();
        byte[] key = value.equals("NULL WITHOUT KEY") ? null : "bad".getBytes(UTF_8);
        byte[] bytes = value.startsWith("NULL") ? null : bytes(repeated(value));
        return new BadRecord(parts[0].strip(), parts[1].strip(), parts[2].strip(), key, bytes);
    }

    private static String repeated(String text) {
        return REPEATED.matcher(text)
                .replaceAll(found -> Matcher.quoteReplacement(found.group(2).repeat(Integer.parseInt(found.group(1)))));
    }

    private static byte[] bytes(String text) {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        for (int i = 0; i < text.length(); i++) {
            if (text.startsWith("\\x", i)) {
                bytes.write(Integer.parseInt(text.substring(i + 2, i + 4), 16));
                i += 3;
            } else {
                bytes.writeBytes(text.substring(i, i + 1).getBytes(UTF_8));
            }
        }
        return bytes.toByteArray();
    }
}
