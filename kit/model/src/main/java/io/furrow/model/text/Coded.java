package io.furrow.model.text;

import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonValue;

/** An enum whose constants records, messages and options name. */
public interface Coded {
    String name();

    /** The name in lower case with hyphens, for instance {@code not-json}. */
    @JsonValue
    default String code() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }
}
