package io.furrow.simulators.mqtt;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.SplittableRandom;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class MessageQueueTest {
    private static final long MUCH = 1_000_000;

    /** A connection that breaks at any time, before and after the broker got what was sent; the last one holds. */
    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void bringsEveryMessageInOrderHoweverOftenTheConnectionBreaks(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        MessageQueue queue = new MessageQueue(1000, MUCH);
        List<Integer> arrived = new ArrayList<>();
        List<Long> onTheirWayBack = new ArrayList<>();
        int added = 0;
        while (added < 500 || queue.open() > 0) {
            if (added < 500) {
                queue.add(message(added++));
            }
            double chance = random.nextDouble();
            if (chance < 0.1 && added < 500) {
                queue.broken();
            } else if (queue.first() != null && (chance < 0.8 || added == 500)) {
                long number = queue.first().getKey();
                if (random.nextDouble() < 0.9 || added == 500) {
                    arrived.add(number(queue.first().getValue()));
                    onTheirWayBack.add(number);
                    queue.sent(number);
                } else {
                    queue.sent(number);
                    queue.broken();
                }
            }
            if (chance > 0.5 || added == 500) {
                onTheirWayBack.forEach(queue::acknowledged);
                onTheirWayBack.clear();
            }
        }

        List<Integer> first = List.copyOf(new LinkedHashSet<>(arrived));
        assertThat(first).hasSize(500).isSorted();
        assertThat(queue.acknowledged()).isEqualTo(500);
        assertThat(queue.dropped()).isZero();
    }

    @Test
    void dropsTheOldestWhenWhatWaitsOrIsUnderWayIsTooLarge() {
        MessageQueue queue = new MessageQueue(1000, 10_000);
        for (int i = 0; i < 9; i++) {
            queue.add(new MessageQueue.Message("t", new byte[1500]));
        }
        assertThat(queue.open()).isEqualTo(5);
        assertThat(queue.dropped()).isEqualTo(4);
        assertThat(queue.first().getKey()).isEqualTo(4);

        queue.sent(4);
        queue.acknowledged(4);
        queue.add(new MessageQueue.Message("t", new byte[1500]));
        assertThat(queue.open()).isEqualTo(5);
        assertThat(queue.dropped()).isEqualTo(4);

        queue.add(new MessageQueue.Message("t", new byte[50_000]));
        assertThat(queue.open()).as("one may be larger than all that fits").isEqualTo(1);
    }

    @Test
    void dropsTheOldestWhenTooManyWait() {
        MessageQueue queue = new MessageQueue(3, MUCH);
        for (int i = 0; i < 5; i++) {
            queue.add(message(i));
        }

        assertThat(queue.dropped()).isEqualTo(2);
        assertThat(number(queue.first().getValue())).isEqualTo(2);
        assertThat(queue.open()).isEqualTo(3);
    }

    @Test
    void countsAnAcknowledgementOnce() {
        MessageQueue queue = new MessageQueue(3, MUCH);
        queue.add(message(0));
        queue.sent(0);
        queue.broken();

        queue.acknowledged(0);
        queue.acknowledged(0);

        assertThat(queue.acknowledged()).isEqualTo(1);
        assertThat(queue.open()).isZero();
    }

    private static MessageQueue.Message message(int number) {
        return new MessageQueue.Message("t", Integer.toString(number).getBytes(UTF_8));
    }

    private static int number(MessageQueue.Message message) {
        return Integer.parseInt(new String(message.payload(), UTF_8));
    }
}
