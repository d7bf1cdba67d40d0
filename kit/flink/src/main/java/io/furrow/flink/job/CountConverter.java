package io.furrow.flink.job;

import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

/** Converts whole numbers from 1 on that a broker accepts as numbers of partitions and replicas. */
public final class CountConverter implements ITypeConverter<Integer> {
    @Override
    public Integer convert(String text) {
        try {
            int count = Short.parseShort(text);
            if (count >= 1) {
                return count;
            }
        } catch (NumberFormatException e) {
            throw refused(text);
        }
        throw refused(text);
    }

    private static TypeConversionException refused(String text) {
        return new TypeConversionException("'" + text + "' is not a whole number from 1 to " + Short.MAX_VALUE);
    }
}
