package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

/** Generates mostly well-formed entities with all that devices, brokers and robots write, and much more. */
public record MadeUpEntities(Random random) {
    private static final String[] NAMES = {
        "location", "Latitude", "Longitude", "gnss", "pose", "temperature", "Mission", "TimeInstant",
        "Time", "speed", "other", "Image", "id", "type", "na\\u006de", "\\ud83d\\ude9c",
        "\\ud83d"
    };
    private static final String[] NUMBERS = """
            0 -0 -0.0 1 40.3125 -3.70379 89.999999999999999999 1.5e1 -3.7E-4 1e400 1e-400 0e1 0.0e99999999999 1e999
            1e1000 1e1001 1e-1001 1e99999999999 181 123456789012345678901234567890 1795223400000 1.7952234e12
            999999999999999999 9007199254740993 0.1000000000000000055511151231257827""".split("\\s+");
    private static final String[] TEXTS = {
        "",
        " ",
        "a",
        "Point",
        "40.41",
        " -3.7 ",
        "40.41, -3.7",
        "1,2,3",
        "NaN",
        "1e400",
        "-0.0,1",
        "2026-11-21T01:00:00Z",
        "2026-11-21T01:00:00.123456789+01:00",
        "1795223400000",
        "hoeing",
        "Ñandú",
        "\\ud83d\\ude9c",
        "\\ud800",
        "\\u0041",
        "\\n",
        "{%27latitude%27:40.41,%27longitude%27:-3.7}",
        "{%27latitude%27: %2740%27, %27longitude%27: -0.0, %27x%27: [1, {}]}",
        "{%27latitude%27:1,%27latitude%27:2}",
        "{%27latitude%27:1} x",
        "[%271%27]",
        "{%27longitude%27:1e99999999999}",
        "{%27latitude%27:7e-5,%27longitude%27:1, %27ñ%27:%27%2%27}",
        "%27",
        "{%27latitude%27:null,%27longitude%27:true}"
    };

    public String next() {
        List<String> members = new ArrayList<>();
        if (random.nextInt(40) > 0) {
            members.add("\"id\":"
                    + (random.nextInt(30) > 0 ? "\"urn:ngsi-ld:Robot:" + random.nextInt(9) + "\"" : value(0)));
        }
        if (random.nextInt(4) > 0) {
            members.add("\"type\":" + (random.nextInt(30) > 0 ? "\"Robot\"" : value(0)));
        }
        for (int attributes = random.nextInt(6); attributes > 0; attributes--) {
            String name = NAMES[random.nextInt(random.nextInt(8) == 0 ? NAMES.length : 12)];
            members.add("\"" + name + "\":" + (random.nextInt(60) > 0 ? attribute() : value(0)));
        }
        Collections.shuffle(members, random);
        return space() + "{" + String.join("," + space(), members) + "}" + (random.nextInt(200) == 0 ? "x" : space());
    }

    private String attribute() {
        List<String> members = new ArrayList<>();
        if (random.nextInt(60) > 0) {
            members.add("\"value\":" + value(0));
        }
        if (random.nextInt(3) > 0) {
            members.add("\"type\":" + (random.nextInt(20) > 0 ? "\"Number\"" : value(0)));
        }
        if (random.nextInt(3) > 0) {
            members.add("\"metadata\":" + (random.nextInt(8) > 0 ? "{}" : value(0)));
        }
        if (random.nextInt(20) == 0) {
            members.add(text(NAMES) + ":" + value(0));
        }
        Collections.shuffle(members, random);
        return "{" + String.join(",", members) + "}";
    }

    private String value(int depth) {
        return switch (random.nextInt(depth > 3 ? 6 : 11)) {
            case 0 -> "null";
            case 1 -> random.nextBoolean() ? "true" : "false";
            case 2, 3 -> NUMBERS[random.nextInt(NUMBERS.length)];
            case 4 -> Double.toString(360 * random.nextDouble() - 180);
            case 5 -> text(TEXTS);
            case 6 -> "[" + value(depth + 1) + "," + space() + value(depth + 1) + "]";
            case 7 -> random.nextInt(10) == 0 ? deep() : "[]";
            case 8 -> "{" + text(NAMES) + ":" + value(depth + 1) + "," + text(NAMES) + ":" + value(depth + 1) + "}";
            case 9 -> point(depth);
            default -> "{\"type\":\"Point\",\"coordinates\":[-3.70379,40.4168]}";
        };
    }

    private String point(int depth) {
        List<String> members = new ArrayList<>(List.of(
                "\"type\":" + (random.nextInt(5) > 0 ? "\"Point\"" : value(depth + 1)),
                "\"coordinates\":" + (random.nextInt(5) > 0 ? coordinates(depth) : value(depth + 1))));
        if (random.nextInt(5) == 0) {
            members.add(text(NAMES) + ":" + value(depth + 1));
        }
        Collections.shuffle(members, random);
        return "{" + String.join(",", members) + "}";
    }

    private String coordinates(int depth) {
        List<String> all = new ArrayList<>();
        for (int i = random.nextInt(4); i >= 0; i--) {
            all.add(random.nextInt(6) > 0 ? NUMBERS[random.nextInt(9)] : value(depth + 1));
        }
        return "[" + String.join(",", all) + "]";
    }

    /** Returns a nesting around the limit. */
    private String deep() {
        int depth = 55 + random.nextInt(12);
        return "[".repeat(depth) + "]".repeat(depth);
    }

    private String text(String[] texts) {
        return "\"" + texts[random.nextInt(texts.length)] + "\"";
    }

    private String space() {
        return random.nextInt(10) == 0 ? " \n" : "";
    }
}
