package io.furrow.model.event;

import java.math.BigDecimal;

import com.fasterxml.jackson.core.io.NumberOutput;
import com.fasterxml.jackson.databind.JsonNode;

/** Writes a number in a canonical form, that of a decimal number without trailing zeros. */
final class CanonicalNumber {
    private CanonicalNumber() {}

    static String of(JsonNode number) {
        return switch (number.numberType()) {
            case DOUBLE -> of(number.doubleValue());
            default -> of(number.decimalValue());
        };
    }

    /** Returns the same text as after writing and reading the number; most are canonical when written. */
    private static String of(double number) {
        String written = NumberOutput.toString(number, true);
        return isCanonical(written) ? written : of(new BigDecimal(written));
    }

    /** Returns whether it has digits behind the point, the last of them not 0, and no exponent. */
    private static boolean isCanonical(String written) {
        char last = written.charAt(written.length() - 1);
        return last >= '1' && last <= '9' && written.indexOf('E') < 0 && written.indexOf('.') > 0;
    }

    private static String of(BigDecimal number) {
        return number.signum() == 0 ? "0" : number.stripTrailingZeros().toString();
    }
}
