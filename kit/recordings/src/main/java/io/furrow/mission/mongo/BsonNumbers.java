package io.furrow.mission.mongo;

import java.math.BigDecimal;
import java.math.BigInteger;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.bson.BsonReader;
import org.bson.BsonWriter;
import org.bson.types.Decimal128;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Converts JSON numbers to BSON without loss of digits: whole numbers as 32 or 64 bits if they fit; decimals as a
 * double if it prints the same digits, otherwise as a Decimal128, which has 34 digits. Longer numbers are rejected.
 */
final class BsonNumbers {
    private static final JsonNodeFactory NODES = new JsonNodeFactory(true);
    /** Maximum digits that a double may represent exactly. */
    private static final int DIGITS_OF_A_DOUBLE = 17;

    private BsonNumbers() {}

    static void write(BsonWriter out, JsonNode number) throws UnreadableException {
        if (number.isInt()) {
            out.writeInt32(number.intValue());
        } else if (number.isLong()) {
            out.writeInt64(number.longValue());
        } else {
            BigDecimal exact = number.decimalValue();
            if (exact.scale() == 0) {
                writeWhole(out, exact);
            } else {
                writeDecimal(out, exact);
            }
        }
    }

    private static void writeWhole(BsonWriter out, BigDecimal whole) throws UnreadableException {
        BigInteger value = whole.unscaledValue();
        if (value.bitLength() < Integer.SIZE) {
            out.writeInt32(value.intValue());
        } else if (value.bitLength() < Long.SIZE) {
            out.writeInt64(value.longValue());
        } else {
            out.writeDecimal128(decimal128(whole));
        }
    }

    private static void writeDecimal(BsonWriter out, BigDecimal exact) throws UnreadableException {
        if (exact.precision() <= DIGITS_OF_A_DOUBLE) {
            double rounded = exact.doubleValue();
            if (Double.isFinite(rounded) && decimal(rounded).equals(exact)) {
                out.writeDouble(rounded);
                return;
            }
        }
        out.writeDecimal128(decimal128(exact));
    }

    private static Decimal128 decimal128(BigDecimal exact) throws UnreadableException {
        try {
            return new Decimal128(exact);
        } catch (NumberFormatException e) {
            throw new UnreadableException(
                    Reason.REFUSED,
                    "a number of %d digits is more than MongoDB holds, which is 34".formatted(exact.precision()),
                    e);
        }
    }

    /** Reads a number of one of the four types. */
    static JsonNode read(BsonReader in) {
        return switch (in.getCurrentBsonType()) {
            case INT32 -> NODES.numberNode(in.readInt32());
            case INT64 -> NODES.numberNode(in.readInt64());
            case DOUBLE -> ofDouble(in.readDouble());
            case DECIMAL128 -> ofDecimal(in.readDecimal128());
            default -> throw new IllegalArgumentException(in.getCurrentBsonType() + " is not a number");
        };
    }

    private static JsonNode ofDouble(double value) {
        // JSON has no infinity and NaN, which ingest does not write; they become text.
        return Double.isFinite(value) ? NODES.numberNode(decimal(value)) : NODES.textNode(Double.toString(value));
    }

    private static JsonNode ofDecimal(Decimal128 value) {
        if (value.isNaN() || value.isInfinite()) {
            return NODES.textNode(value.toString());
        }
        BigDecimal exact = value.isNegative() && value.equals(Decimal128.NEGATIVE_ZERO)
                ? BigDecimal.ZERO
                : value.bigDecimalValue();
        return exact.scale() == 0 ? NODES.numberNode(exact.unscaledValue()) : NODES.numberNode(exact);
    }

    private static BigDecimal decimal(double value) {
        return new BigDecimal(Double.toString(value));
    }
}
