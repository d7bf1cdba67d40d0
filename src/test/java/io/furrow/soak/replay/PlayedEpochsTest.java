package io.furrow.soak.replay;

import org.junit.jupiter.api.Test;

import io.furrow.soak.replay.PlayedEpochs.Entry;

import static org.assertj.core.api.Assertions.assertThat;

class PlayedEpochsTest {
    private final PlayedEpochs epochs = new PlayedEpochs();

    private void event(long epoch, long sequence, long number) {
        epochs.add(epoch, sequence, new Entry("event", 0, number));
    }

    private void end(long epoch, long sequence) {
        epochs.add(epoch, sequence, new Entry("end", 0, -1));
        epochs.add(epoch, sequence, new Entry("end", 1, -1));
    }

    @Test
    void findsNoFaultInCompleteEpochs() {
        epochs.add(0, 0, new Entry("prime", 1, -1));
        event(0, 1, 7);
        event(0, 2, 8);
        end(0, 3);
        event(1, 0, 0);
        end(1, 1);

        assertThat(epochs.gaps()).isEmpty();
        assertThat(epochs.faultsOfExactlyOnce(2)).isEmpty();
        assertThat(epochs.repeated()).isZero();
        assertThat(epochs.count()).isEqualTo(2);
    }

    @Test
    void findsAMissingEvent() {
        event(3, 0, 0);
        event(3, 2, 2);
        end(3, 3);

        assertThat(epochs.gaps()).containsExactly("epoch 3: 1 to 1 are missing");
    }

    @Test
    void findsAMissingFirstEvent() {
        event(0, 1, 1);

        assertThat(epochs.gaps()).containsExactly("epoch 0: 0 to 0 are missing");
    }

    @Test
    void findsRepeatedRecords() {
        event(0, 0, 0);
        event(0, 0, 0);
        end(0, 1);

        assertThat(epochs.repeated()).isEqualTo(1);
        assertThat(epochs.gaps()).isEmpty();
        assertThat(epochs.faultsOfExactlyOnce(2)).containsExactly("epoch 0: 0 is there 2 times");
    }

    @Test
    void findsAReusedSequence() {
        event(0, 0, 4);
        event(0, 1, 5);
        event(0, 0, 4);
        event(0, 1, 9);

        assertThat(epochs.changed()).containsExactly("epoch 0: 1 has the events [5, 9]");
    }

    @Test
    void findsASkippedEvent() {
        event(0, 0, 4);
        event(0, 1, 6);
        end(0, 2);

        assertThat(epochs.faultsOfExactlyOnce(2)).containsExactly("epoch 0: event 6 follows event 4");
    }

    @Test
    void findsAnEndThatIsNotOnEveryPartition() {
        event(0, 0, 0);
        end(0, 1);

        assertThat(epochs.faultsOfExactlyOnce(3)).singleElement().asString().contains("does not end once");
    }
}
