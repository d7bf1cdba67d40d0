package io.furrow.model.text;

import java.util.Arrays;
import java.util.Locale;
import java.util.Optional;

import com.fasterxml.jackson.annotation.JsonValue;

/** An enum whose constants have codes in records, messages and options. */
public interface Coded {
    String name();

    /** Returns the name in lower case with hyphens, for instance {@code not-json}. */
    @JsonValue
    default String code() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    /** Returns the constant of a code; empty if there is none. */
    static <E extends Coded> Optional<E> find(E[] all, String code) {
        return Arrays.stream(all).filter(each -> each.code().equals(code)).findFirst();
    }
}
