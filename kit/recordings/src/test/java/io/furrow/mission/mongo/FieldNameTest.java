package io.furrow.mission.mongo;

import java.util.HashSet;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class FieldNameTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
                    Temperature | Temperature
                    a.b.        | a%2Eb%2E
                    $set        | %24set
                    a$b         | a$b
                    50%         | 50%25
                    %2E         | %252E
                    é°          | é°
                    _id         | %5Fid
                    _           | %5F
                    _$x         | %5F$x
                    ""          | %
                    """)
    void encodesNamesThatMongoWouldMisread(String name, String field) {
        assertThat(FieldName.ofAttribute(name)).isEqualTo(field);
        assertThat(FieldName.decode(field)).isEqualTo(name);
    }

    @Test
    void keepsAnUnderscoreAtALowerLevel() {
        assertThat(FieldName.of("_id")).isEqualTo("_id");
    }

    @Test
    void encodesANullByte() {
        assertThat(FieldName.of("a\0b")).isEqualTo("a%00b");
        assertThat(FieldName.decode("a%00b")).isEqualTo("a\0b");
    }

    @Test
    void givesNoTwoNamesOneField() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        Set<String> names = new HashSet<>();
        Set<String> fields = new HashSet<>();
        for (int i = 0; i < 20_000; i++) {
            StringBuilder name = new StringBuilder();
            for (int length = random.nextInt(6); length > 0; length--) {
                name.append("%.$_\0002E5F4aé".charAt(random.nextInt(12)));
            }
            names.add(name.toString());
            String field = FieldName.ofAttribute(name.toString());
            fields.add(field);
            assertThat(FieldName.decode(field)).as("seed %d", seed).isEqualTo(name.toString());
            assertThat(field).doesNotContain(".", "\0").doesNotStartWith("$").doesNotStartWith("_");
        }
        assertThat(fields).hasSameSizeAs(names);
    }
}
