package io.furrow.model.text;

import java.util.Arrays;
import java.util.Locale;
import java.util.Optional;

import com.fasterxml.jackson.annotation.JsonValue;

/** An enum whose constants records, messages and options name. */
public interface Coded {
    String name();

    /** The name in lower case with hyphens, for instance {@code not-json}. */
    @JsonValue
    default String code() {
        return name().toLowerCase(Locale.ROOT).replace('_', '-');
    }

    /** The constant of a code; empty if none has it. */
    static <E extends Coded> Optional<E> find(E[] all, String code) {
        return Arrays.stream(all).filter(each -> each.code().equals(code)).findFirst();
    }
}
