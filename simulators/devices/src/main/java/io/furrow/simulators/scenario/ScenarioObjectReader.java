package io.furrow.simulators.scenario;

import java.time.DateTimeException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;

/** Reads the members of a JSON object by name; {@link #end()} refuses the members that were not read. */
final class ScenarioObjectReader {
    private static final Duration MAX = Duration.ofDays(365);

    private final JsonNode json;
    private final String path;
    private final Set<String> members = new TreeSet<>();

    private ScenarioObjectReader(JsonNode json, String path) {
        this.json = json;
        this.path = path;
    }

    /** @param path of the object, empty for the whole file */
    static ScenarioObjectReader of(JsonNode json, String path) throws InvalidScenarioException {
        if (!json.isObject()) {
            throw new InvalidScenarioException(path.isEmpty() ? "the file" : path, "must be an object {…}");
        }
        return new ScenarioObjectReader(json, path);
    }

    boolean has(String name) {
        members.add(name);
        return json.hasNonNull(name);
    }

    JsonNode node(String name) {
        members.add(name);
        return json.path(name);
    }

    String text(String name) throws InvalidScenarioException {
        JsonNode value = node(name);
        if (!value.isTextual() || value.textValue().isBlank()) {
            throw refused(name, "must be a text" + found(value));
        }
        return value.textValue();
    }

    String text(String name, String otherwise) throws InvalidScenarioException {
        return has(name) ? text(name) : otherwise;
    }

    /** A text that devices report as an attribute value. */
    String reported(String name, String otherwise) throws InvalidScenarioException {
        String text = text(name, otherwise);
        if (text.matches(".*[<>\"'=;()].*")) {
            throw refused(
                    name,
                    "must not contain any of < > \" ' = ; ( ), which the context broker refuses in a text"
                            + found(node(name)));
        }
        return text;
    }

    boolean truth(String name, boolean otherwise) throws InvalidScenarioException {
        if (has(name) && !node(name).isBoolean()) {
            throw refused(name, "must be true or false" + found(node(name)));
        }
        return node(name).asBoolean(otherwise);
    }

    double number(String name, double min, double max) throws InvalidScenarioException {
        JsonNode value = node(name);
        double number = value.asDouble(Double.NaN);
        if (!value.isNumber() || !(number >= min && number <= max)) {
            throw refused(name, "must be a number from %s to %s%s".formatted(plain(min), plain(max), found(value)));
        }
        return number;
    }

    double number(String name, double min, double max, double otherwise) throws InvalidScenarioException {
        return has(name) ? number(name, min, max) : otherwise;
    }

    long whole(String name, long min, long max, long otherwise) throws InvalidScenarioException {
        JsonNode value = node(name);
        if (!has(name)) {
            return otherwise;
        }
        if (!value.isIntegralNumber()
                || !value.canConvertToLong()
                || value.longValue() < min
                || value.longValue() > max) {
            throw refused(name, "must be a whole number from %d to %d%s".formatted(min, max, found(value)));
        }
        return value.longValue();
    }

    Duration duration(String name) throws InvalidScenarioException {
        JsonNode value = node(name);
        try {
            Duration duration = Duration.parse(value.asText());
            if (!duration.isNegative() && duration.compareTo(MAX) <= 0) {
                return duration;
            }
        } catch (DateTimeException e) {
            throw refused(name, "must be a duration, for instance PT1S or PT10M" + found(value));
        }
        throw refused(name, "must be a duration from PT0S to P365D" + found(value));
    }

    Duration duration(String name, Duration otherwise) throws InvalidScenarioException {
        return has(name) ? duration(name) : otherwise;
    }

    ScenarioObjectReader object(String name) throws InvalidScenarioException {
        return of(node(name), at(name));
    }

    List<ScenarioObjectReader> objects(String name) throws InvalidScenarioException {
        if (!node(name).isArray()) {
            throw refused(name, "must be a list […]" + found(node(name)));
        }
        List<ScenarioObjectReader> objects = new ArrayList<>();
        for (JsonNode each : node(name)) {
            objects.add(of(each, at(name) + "[" + objects.size() + "]"));
        }
        return objects;
    }

    /** Refuses unknown members. */
    void end() throws InvalidScenarioException {
        for (var names = json.fieldNames(); names.hasNext(); ) {
            String name = names.next();
            if (!members.contains(name)) {
                throw refused(name, "is not known here; known are " + String.join(", ", members));
            }
        }
    }

    InvalidScenarioException refused(String name, String sentence) {
        return new InvalidScenarioException(at(name), sentence);
    }

    /** Refuses a member with the message of a model class. */
    InvalidScenarioException refused(String name, IllegalArgumentException rule) {
        return new InvalidScenarioException(at(name), rule.getMessage(), rule);
    }

    String path() {
        return path;
    }

    private String at(String name) {
        return path.isEmpty() ? name : path + "." + name;
    }

    private static String found(JsonNode value) {
        return value.isMissingNode() ? ", and is missing" : ", not " + value;
    }

    private static String plain(double number) {
        return number == Math.rint(number) ? String.format(Locale.ROOT, "%.0f", number) : Double.toString(number);
    }
}
