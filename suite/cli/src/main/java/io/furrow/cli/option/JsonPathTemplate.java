package io.furrow.cli.option;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import java.util.function.Function;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * A template in the JSONPath of kubectl: text with expressions in braces, as {@code {.mission}},
 * {@code {.items[?(@.status.state=="running")].mission}} or {@code {range .items[*]}{.mission}{"\n"}{end}}. A list is its
 * own member {@code items}. Values of an expression are separated by spaces; what does not exist is left out.
 */
final class JsonPathTemplate {
    private static final Pattern EXPRESSION = Pattern.compile("\\{\\s*((?:\"[^\"]*\"|'[^']*'|[^{}\"'])*?)\\s*}");
    private static final Pattern STEP = Pattern.compile(
            "\\.\\.(?<deep>[\\w-]+)|\\.(?<member>[\\w-]+)"
                    + "|\\[(?<quoted>'[^']*'|\"[^\"]*\")]|(?<all>\\.\\*|\\[\\*])|\\[(?<index>-?\\d{1,9})]"
                    + "|\\[\\?\\(\\s*@(?<path>[^=!<>'\"]*?)\\s*(?:(?<operator>[=!<>]=|[<>])\\s*(?<value>'[^']*'|\"[^\"]*\"|[\\w.+-]+)\\s*)?\\)]");
    private static final String LIST = "items";

    private final List<Part> parts;

    /** A part of a template, which prints what it finds in a value. */
    private interface Part {
        void print(JsonNode value, StringBuilder out);
    }

    /** Finds values in a value. */
    private interface Path extends Function<JsonNode, Stream<JsonNode>> {}

    private JsonPathTemplate(List<Part> parts) {
        this.parts = parts;
    }

    /** @throws IllegalArgumentException if it is no template; the message says where */
    static JsonPathTemplate parse(String template) {
        Deque<List<Part>> open = new ArrayDeque<>(List.of(new ArrayList<>()));
        Deque<Path> ranges = new ArrayDeque<>();
        Matcher expressions = EXPRESSION.matcher(template);
        int at = 0;
        for (int brace = template.indexOf('{'); brace >= 0; brace = template.indexOf('{', at)) {
            open.peek().add(text(template.substring(at, brace)));
            requireThat(expressions.region(brace, template.length()).lookingAt(), "'{' is not closed", template, brace);
            String expression = expressions.group(1);
            if (expression.equals("end")) {
                requireThat(!ranges.isEmpty(), "no range is open", template, brace);
                List<Part> inner = open.pop();
                open.peek().add(range(ranges.pop(), inner));
            } else if (expression.startsWith("range ")) {
                ranges.push(path(expression.substring("range ".length()).strip()));
                open.push(new ArrayList<>());
            } else {
                open.peek()
                        .add(isQuoted(expression) ? text(unescaped(unquoted(expression))) : values(path(expression)));
            }
            at = expressions.end();
        }
        requireThat(at > 0, "it has no expression in braces, such as {.items[*].mission}", template, 0);
        requireThat(ranges.isEmpty(), "{end} of a range is missing", template, template.length());
        open.peek().add(text(template.substring(at)));
        return new JsonPathTemplate(open.pop());
    }

    /** Prints what the template finds in an answer. */
    String print(JsonNode answer) {
        StringBuilder out = new StringBuilder();
        parts.forEach(part -> part.print(answer, out));
        return out.toString();
    }

    private static Part text(String text) {
        return (value, out) -> out.append(text);
    }

    private static Part values(Path path) {
        return (value, out) -> out.append(path.apply(value)
                .map(each -> each.isValueNode() ? each.asText() : each.toString())
                .collect(Collectors.joining(" ")));
    }

    private static Part range(Path path, List<Part> inner) {
        return (value, out) -> path.apply(value).forEach(each -> inner.forEach(part -> part.print(each, out)));
    }

    private static Path path(String expression) {
        Matcher step = STEP.matcher(expression);
        int at = expression.startsWith("$") || expression.startsWith("@") ? 1 : 0;
        Path path = Stream::of;
        while (at < expression.length() && !expression.substring(at).equals(".")) {
            requireThat(step.region(at, expression.length()).lookingAt(), "cannot be read", expression, at);
            Path before = path;
            Path next = step(step);
            path = value -> before.apply(value).flatMap(next).filter(found -> !found.isMissingNode());
            at = step.end();
        }
        return path;
    }

    private static Path step(Matcher step) {
        if (step.group("deep") != null) {
            String name = step.group("deep");
            return value -> value.findValues(name).stream();
        } else if (step.group("member") != null) {
            return member(step.group("member"));
        } else if (step.group("quoted") != null) {
            return member(unquoted(step.group("quoted")));
        } else if (step.group("index") != null) {
            int index = Integer.parseInt(step.group("index"));
            return value -> Stream.of(value.path(index < 0 ? value.size() + index : index));
        } else if (step.group("path") != null) {
            Path path = path(step.group("path"));
            Predicate<JsonNode> condition = condition(step.group("operator"), step.group("value"));
            return value -> value.valueStream().filter(each -> path.apply(each).anyMatch(condition));
        }
        return JsonNode::valueStream;
    }

    private static Path member(String name) {
        return value -> Stream.of(value.isArray() && name.equals(LIST) ? value : value.path(name));
    }

    /** @param operator null where it suffices that there is a value */
    private static Predicate<JsonNode> condition(String operator, String literal) {
        if (operator == null) {
            return value -> true;
        }
        String other = isQuoted(literal) ? unquoted(literal) : literal;
        boolean isNumber = !isQuoted(literal) && literal.matches("[+-]?(\\d+\\.?\\d*|\\.\\d+)([eE][+-]?\\d+)?");
        return value -> {
            int order = isNumber && value.isNumber()
                    ? Double.compare(value.doubleValue(), Double.parseDouble(other))
                    : value.asText().compareTo(other);
            return switch (operator) {
                case "==" -> order == 0;
                case "!=" -> order != 0;
                case "<" -> order < 0;
                case "<=" -> order <= 0;
                case ">" -> order > 0;
                default -> order >= 0;
            };
        };
    }

    private static boolean isQuoted(String text) {
        return text.startsWith("\"") || text.startsWith("'");
    }

    private static String unquoted(String text) {
        return text.substring(1, text.length() - 1);
    }

    private static String unescaped(String text) {
        return text.replace("\\n", "\n").replace("\\t", "\t");
    }

    private static void requireThat(boolean condition, String fault, String text, int at) {
        if (!condition) {
            throw new IllegalArgumentException(
                    "'%s' is no JSONPath: %s at character %d".formatted(text, fault, at + 1));
        }
    }
}
