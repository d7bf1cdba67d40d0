package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Mutates JSON at random: replaces values, names or bytes, or truncates it. */
public record Mutations(Random random) {
    private static final String[] SPLICES = {
        "null", "{}", "[]",
        "1e999", "-1e999999999", "1000e2147483647",
        "1e99999999999", "\"\\ud800\"", "NaN",
        "\"\"", "{\"value\":null}", "{\"type\":null,\"value\":1,\"metadata\":[]}",
        "\"%27\"", "[[[[]]]]", "\"0,0\"",
        "-1", "true", "{\"type\":\"Point\",\"coordinates\":{\"a\":1,\"b\":2}}",
        "\"9999-12-31T23:59:59Z\"", "999999999999999999", "\"+999999999-12-31T23:59:59Z\"",
        "\"2026-11-21T01:00:00/\""
    };
    private static final String[] NAMES = """
            id type data value metadata location Time TimeInstant dateObserved dateModified Latitude Longitude gnss
            coordinates""".split("\\s+");

    public byte[] of(byte[] body) {
        String text = new String(body, UTF_8);
        for (int changes = 1 + random.nextInt(3); changes > 0; changes--) {
            text = switch (random.nextInt(10)) {
                case 0, 1, 2, 3 -> replaceValue(text);
                case 4, 5, 6 -> rename(text);
                case 7 -> text.substring(0, random.nextInt(text.length() + 1));
                default -> text;
            };
        }
        byte[] bytes = text.getBytes(UTF_8);
        if (bytes.length > 0 && random.nextInt(5) == 0) {
            bytes[random.nextInt(bytes.length)] = (byte) random.nextInt(256);
        }
        return bytes;
    }

    /** Replaces a value, which follows a colon up to the next structural character. */
    private String replaceValue(String text) {
        List<Integer> colons = new ArrayList<>();
        for (int at = text.indexOf("\":"); at >= 0; at = text.indexOf("\":", at + 1)) {
            colons.add(at + 2);
        }
        if (colons.isEmpty()) {
            return text;
        }
        int from = colons.get(random.nextInt(colons.size()));
        int to = from;
        while (to < text.length() && ",}]".indexOf(text.charAt(to)) < 0) {
            to++;
        }
        boolean container = from < text.length() && "{[".indexOf(text.charAt(from)) >= 0;
        return text.substring(0, from)
                + SPLICES[random.nextInt(SPLICES.length)]
                + text.substring(container ? closing(text, from) : to);
    }

    private static int closing(String text, int open) {
        int depth = 0;
        for (int at = open; at < text.length(); at++) {
            depth += "{[".indexOf(text.charAt(at)) >= 0 ? 1 : "}]".indexOf(text.charAt(at)) >= 0 ? -1 : 0;
            if (depth == 0) {
                return at + 1;
            }
        }
        return text.length();
    }

    private String rename(String text) {
        String from = random.nextBoolean() ? "moisture" : "temperature";
        return text.replaceFirst("\"" + from + "\":", "\"" + NAMES[random.nextInt(NAMES.length)] + "\":");
    }
}
