package io.furrow.connect.subscription;

import java.util.Random;
import java.util.regex.Pattern;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class IdPartitionTest {
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 3, 7, 10, 16, IdPartition.MAX})
    void givesEachIdToExactlyOneTask(int count) {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int i = 0; i < 2000; i++) {
            String id = random.ints(12, '!', 0x180)
                    .filter(sign -> !Character.isISOControl(sign))
                    .collect(StringBuilder::new, StringBuilder::appendCodePoint, StringBuilder::append)
                    .toString();

            long owners = IntStream.range(0, count)
                    .filter(part -> Pattern.compile(new IdPartition(part, count).pattern())
                            .matcher(id)
                            .find())
                    .count();

            assertThat(owners).as("id '%s', seed %d", id, seed).isEqualTo(1);
        }
    }

    @Test
    void spreadsIdsThatEndInDigits() {
        assertThat(new IdPartition(0, 2).pattern()).startsWith("[02468");
        assertThat(new IdPartition(1, 2).pattern()).startsWith("[^02468");
        assertThat(new IdPartition(0, 2).label()).isEqualTo("1/2");
    }

    @Test
    void refusesMorePartsThanThereAreSigns() {
        assertThatThrownBy(() -> new IdPartition(0, IdPartition.MAX + 1))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("0 of 37");
    }
}
