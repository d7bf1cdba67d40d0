package io.furrow.model.ngsi;

import java.io.IOException;
import java.util.Locale;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import com.fasterxml.jackson.core.JsonLocation;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonMappingException;

import io.furrow.model.text.FailureText;

/** Describes what is wrong with JSON for people, without Jackson's classes and constants. */
public final class JsonProblem {
    private static final Pattern END =
            Pattern.compile("^(Unexpected end-of-input|No content to map).*", Pattern.DOTALL);
    private static final Pattern TRAILING = Pattern.compile("^Trailing token.*", Pattern.DOTALL);
    private static final Pattern NO_NUMBER = Pattern.compile("^Non-standard token '([^']*)'.*", Pattern.DOTALL);
    /** Parts of Jackson's messages for programmers: source locations and features that would allow the input. */
    private static final Pattern FOR_PROGRAMMERS = Pattern.compile(
            ", from `[^`]*`|: enable `.*|,? ?\\(?start marker at .*|\\R? at \\[Source.*"
                    + "| \\(for (?:Array|Object) starting at .*| ?\\(not recognized as one since Feature .*",
            Pattern.DOTALL);

    private JsonProblem() {}

    /** Returns for instance {@code unexpected end of input at line 1, column 17}. */
    public static String of(IOException failure) {
        if (!(failure instanceof JsonProcessingException json)) {
            return FailureText.of(failure); // bytes that are not UTF-8
        }
        String words = words(json);
        JsonLocation at = json.getLocation();
        return words.substring(0, 1).toLowerCase(Locale.ROOT)
                + words.substring(1)
                + (at == null ? "" : " at line " + at.getLineNr() + ", column " + at.getColumnNr());
    }

    /** Returns the description as a sentence, without the location. */
    public static String words(JsonProcessingException failure) {
        if (failure instanceof JsonMappingException mapping
                && !mapping.getPath().isEmpty()) {
            return "Member '%s' is not what it must be"
                    .formatted(mapping.getPath().stream()
                            .map(part -> part.getFieldName() == null ? "" + part.getIndex() : part.getFieldName())
                            .collect(Collectors.joining(".")));
        }
        String words = END.matcher(failure.getOriginalMessage()).replaceFirst("Unexpected end of input");
        words = TRAILING.matcher(words).replaceFirst("More than one JSON document");
        words = NO_NUMBER.matcher(words).replaceFirst("The token $1 is not a JSON number; send null instead");
        words = FOR_PROGRAMMERS.matcher(words).replaceAll("");
        return words.contains("`") ? "The value is not what it must be" : words;
    }
}
