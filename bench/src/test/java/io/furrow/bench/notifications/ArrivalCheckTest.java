package io.furrow.bench.notifications;

import java.util.BitSet;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Test;

import io.furrow.bench.http.NotificationRequest;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ArrivalCheckTest {
    private final ArrivalCheck check = new ArrivalCheck(1000);

    @Test
    void countsWhatWasAcknowledgedAndIsNotThere() {
        arrive(1000, 1);
        arrive(1002, 2);
        BitSet acknowledged = new BitSet();
        acknowledged.set(0, 6);

        assertThat(check.missing(acknowledged)).isEqualTo(4);
        assertThat(check.distinct()).isEqualTo(2);
        assertThat(check.repeats()).isZero();
    }

    @Test
    void countsRepeatsApartAndDoesNotTakeThemForTheLastArrival() {
        arrive(1000, 1);
        arrive(1001, 2);
        arrive(1000, 3);

        assertThat(check.distinct()).isEqualTo(2);
        assertThat(check.repeats()).isEqualTo(1);
        assertThat(check.lastNanos()).isEqualTo(2);
    }

    @Test
    void passesOverTheNumbersOfAnEarlierLoad() {
        arrive(999, 1);

        assertThat(check.distinct()).isZero();
        assertThat(check.samples()).isEmpty();
    }

    private void arrive(long number, long nanos) {
        String value = "{%s1%014d}}".formatted(NotificationRequest.BEFORE_NUMBER, number);
        check.add(new ConsumerRecord<>("t", 0, 0, new byte[0], value.getBytes(UTF_8)), nanos);
    }
}
