package io.furrow.simulators.mqtt;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.SplittableRandom;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class MessageQueueTest {
    private static final long MUCH = 1_000_000;

    /** A connection that breaks at any time, before and after the broker got what was sent; the last one holds. */
    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void bringsEveryMessageInOrderHoweverOftenTheConnectionBreaks(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        MessageQueue outbox = new MessageQueue(1000, MUCH);
        List<Integer> arrived = new ArrayList<>();
        List<Long> onTheirWayBack = new ArrayList<>();
        int added = 0;
        while (added < 500 || outbox.open() > 0) {
            if (added < 500) {
                outbox.add(message(added++));
            }
            double chance = random.nextDouble();
            if (chance < 0.1 && added < 500) {
                outbox.broken();
            } else if (outbox.first() != null && (chance < 0.8 || added == 500)) {
                long number = outbox.first().getKey();
                if (random.nextDouble() < 0.9 || added == 500) {
                    arrived.add(number(outbox.first().getValue()));
                    onTheirWayBack.add(number);
                    outbox.sent(number);
                } else {
                    outbox.sent(number);
                    outbox.broken();
                }
            }
            if (chance > 0.5 || added == 500) {
                onTheirWayBack.forEach(outbox::acknowledged);
                onTheirWayBack.clear();
            }
        }

        List<Integer> first = List.copyOf(new LinkedHashSet<>(arrived));
        assertThat(first).hasSize(500).isSorted();
        assertThat(outbox.acknowledged()).isEqualTo(500);
        assertThat(outbox.dropped()).isZero();
    }

    @Test
    void dropsTheOldestWhenWhatWaitsOrIsUnderWayIsTooLarge() {
        MessageQueue outbox = new MessageQueue(1000, 10_000);
        for (int i = 0; i < 9; i++) {
            outbox.add(new MessageQueue.Message("t", new byte[1500]));
        }
        assertThat(outbox.open()).isEqualTo(5);
        assertThat(outbox.dropped()).isEqualTo(4);
        assertThat(outbox.first().getKey()).isEqualTo(4);

        outbox.sent(4);
        outbox.acknowledged(4);
        outbox.add(new MessageQueue.Message("t", new byte[1500]));
        assertThat(outbox.open()).isEqualTo(5);
        assertThat(outbox.dropped()).isEqualTo(4);

        outbox.add(new MessageQueue.Message("t", new byte[50_000]));
        assertThat(outbox.open()).as("one may be larger than all that fits").isEqualTo(1);
    }

    @Test
    void dropsTheOldestWhenTooManyWait() {
        MessageQueue outbox = new MessageQueue(3, MUCH);
        for (int i = 0; i < 5; i++) {
            outbox.add(message(i));
        }

        assertThat(outbox.dropped()).isEqualTo(2);
        assertThat(number(outbox.first().getValue())).isEqualTo(2);
        assertThat(outbox.open()).isEqualTo(3);
    }

    @Test
    void countsAnAcknowledgementOnce() {
        MessageQueue outbox = new MessageQueue(3, MUCH);
        outbox.add(message(0));
        outbox.sent(0);
        outbox.broken();

        outbox.acknowledged(0);
        outbox.acknowledged(0);

        assertThat(outbox.acknowledged()).isEqualTo(1);
        assertThat(outbox.open()).isZero();
    }

    private static MessageQueue.Message message(int number) {
        return new MessageQueue.Message("t", Integer.toString(number).getBytes(StandardCharsets.UTF_8));
    }

    private static int number(MessageQueue.Message message) {
        return Integer.parseInt(new String(message.payload(), StandardCharsets.UTF_8));
    }
}
