package io.furrow.connect.source;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;

import org.junit.jupiter.api.Test;

import io.furrow.connect.source.PendingNotifications.Pending;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class PendingNotificationsTest {
    private final PendingNotifications pending = new PendingNotifications(3, 1000);

    @Test
    void isDurableWhenTheLastRecordIsAcknowledged() throws InterruptedException {
        CompletableFuture<Void> durable =
                pending.take(List.of(record("a"), record("b"))).orElseThrow();
        List<Pending> next = pending.next(10, Duration.ZERO);

        pending.acknowledge(next.get(0).notification());
        assertThat(durable).isNotDone();
        pending.acknowledge(next.get(1).notification());
        assertThat(durable).isCompleted();
        assertThat(pending.count()).isZero();
        assertThat(pending.bytes()).isZero();
    }

    @Test
    void handsRecordsOnInTheirOrderAndNoMoreThanAsked() throws InterruptedException {
        pending.take(List.of(record("a"), record("b")));
        pending.take(List.of(record("c")));

        assertThat(pending.next(2, Duration.ZERO))
                .extracting(next -> next.record().key())
                .containsExactly("a", "b");
        assertThat(pending.next(2, Duration.ZERO))
                .extracting(next -> next.record().key())
                .containsExactly("c");
        assertThat(pending.next(2, Duration.ZERO)).isEmpty();
    }

    @Test
    void hasNoRoomBeyondItsCountUntilOneIsAcknowledged() throws InterruptedException {
        for (int i = 0; i < 3; i++) {
            assertThat(pending.take(List.of(record("a")))).isPresent();
        }
        assertThat(pending.take(List.of(record("a")))).isEmpty();

        List<Pending> next = pending.next(10, Duration.ZERO);
        assertThat(next).as("what found no room is not handed on").hasSize(3);
        pending.acknowledge(next.get(0).notification());
        assertThat(pending.take(List.of(record("a")))).isPresent();
    }

    @Test
    void hasNoRoomBeyondItsBytesExceptForOneAlone() throws InterruptedException {
        assertThat(pending.take(List.of(record("large", 5000)))).isPresent();
        assertThat(pending.take(List.of(record("small", 1)))).isEmpty();

        pending.acknowledge(pending.next(1, Duration.ZERO).get(0).notification());
        assertThat(pending.take(List.of(record("small", 1)))).isPresent();
    }

    @Test
    void isDurableAtOnceWhenThereIsNothingToWrite() {
        assertThat(pending.take(List.of()).orElseThrow()).isCompleted();
    }

    @Test
    void failsWhatIsOpenWhenItCloses() {
        CompletableFuture<Void> open = pending.take(List.of(record("a"))).orElseThrow();

        pending.close();
        pending.close();

        assertThatThrownBy(open::join)
                .isInstanceOf(CompletionException.class)
                .hasCauseInstanceOf(Intake.ClosedException.class);
        assertThat(pending.take(List.of(record("a"))).orElseThrow()).isCompletedExceptionally();
    }

    private static OutgoingRecord record(String key) {
        return record(key, 10);
    }

    private static OutgoingRecord record(String key, int bytes) {
        return new OutgoingRecord("raw", key, new byte[bytes], Instant.EPOCH, Map.of());
    }
}
