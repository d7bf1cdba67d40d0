package io.furrow.fiware.broker;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.regex.PatternSyntaxException;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.NgsiError;

/**
 * The Simple Query Language of NGSI-v2: statements joined by {@code ;}, all of which must hold. {@code attr} exists,
 * {@code !attr} does not, {@code attr==v} (list {@code a,b}, range {@code a..b}), {@code !=}, {@code <}, {@code <=},
 * {@code >}, {@code >=}, {@code ~=} (regular expression). A value in single quotes is text; members of structured
 * values are reached with dots. {@code dateModified} and {@code dateCreated} count as attributes.
 */
public final class QueryFilter implements Predicate<StoredEntity> {
    private static final Pattern STATEMENT = Pattern.compile("([^=!<>~:]+)(==|!=|<=|>=|~=|<|>|:)(.+)", Pattern.DOTALL);
    private static final Pattern OUTSIDE_QUOTES = Pattern.compile(";(?=(?:[^']*'[^']*')*[^']*$)");

    private final List<Predicate<StoredEntity>> statements;

    private QueryFilter(List<Predicate<StoredEntity>> statements) {
        this.statements = statements;
    }

    /** @throws NgsiError 400 */
    public static QueryFilter parse(String q) throws NgsiError {
        List<Predicate<StoredEntity>> statements = new ArrayList<>();
        for (String part : OUTSIDE_QUOTES.split(q, -1)) {
            statements.add(statement(part.trim()));
        }
        return new QueryFilter(statements);
    }

    @Override
    public boolean test(StoredEntity entity) {
        return statements.stream().allMatch(statement -> statement.test(entity));
    }

    private static Predicate<StoredEntity> statement(String text) throws NgsiError {
        Matcher binary = STATEMENT.matcher(text);
        if (binary.matches()) {
            String path = binary.group(1).trim();
            Predicate<JsonNode> comparison =
                    comparison(binary.group(2), binary.group(3).trim());
            return entity -> value(entity, path).filter(comparison).isPresent();
        }
        boolean absent = text.startsWith("!");
        String path = absent ? text.substring(1) : text;
        if (path.isBlank() || path.matches(".*[=<>~!,].*")) {
            throw invalid(text);
        }
        return entity -> value(entity, path).isPresent() != absent;
    }

    private static Predicate<JsonNode> comparison(String operator, String operand) throws NgsiError {
        if (operator.equals("~=")) {
            Predicate<String> pattern = pattern(operand);
            return value -> value.isTextual() && pattern.test(value.textValue());
        }
        if (operator.equals("==") || operator.equals(":")) {
            return QueryOperand.anyOf(operand);
        }
        if (operator.equals("!=")) {
            return QueryOperand.anyOf(operand).negate();
        }
        if (operand.contains("..") || operand.contains(",")) {
            throw NgsiError.badRequest("ranges and lists are only valid for equal and not equal ops");
        }
        QueryOperand other = QueryOperand.of(operand);
        return switch (operator) {
            case "<" -> value -> other.compare(value).stream().anyMatch(order -> order < 0);
            case "<=" -> value -> other.compare(value).stream().anyMatch(order -> order <= 0);
            case ">" -> value -> other.compare(value).stream().anyMatch(order -> order > 0);
            default -> value -> other.compare(value).stream().anyMatch(order -> order >= 0);
        };
    }

    private static Optional<JsonNode> value(StoredEntity entity, String path) {
        switch (path) {
            case "dateModified":
                return Optional.of(JsonNodeFactory.instance.textNode(NgsiTime.format(entity.modified())));
            case "dateCreated":
                return Optional.of(JsonNodeFactory.instance.textNode(NgsiTime.format(entity.created())));
            default:
        }
        Attribute whole = entity.attributes().get(path.replace("'", ""));
        if (whole != null) {
            return Optional.of(whole.value());
        }
        String[] steps = path.split("\\.");
        Attribute root = entity.attributes().get(steps[0]);
        if (root == null || steps.length == 1) {
            return Optional.empty();
        }
        JsonNode value = root.value();
        for (int i = 1; i < steps.length; i++) {
            value = value.path(steps[i]);
        }
        return value.isMissingNode() ? Optional.empty() : Optional.of(value);
    }

    public static Predicate<String> pattern(String regex) throws NgsiError {
        try {
            return Pattern.compile(regex).asPredicate();
        } catch (PatternSyntaxException e) {
            throw NgsiError.badRequest("invalid regular expression: " + regex);
        }
    }

    private static NgsiError invalid(String q) {
        return NgsiError.badRequest("invalid query expression: " + q);
    }
}
