package io.furrow.model.text;

import java.io.IOException;
import java.net.ConnectException;
import java.net.UnknownHostException;
import java.nio.channels.ClosedChannelException;
import java.util.concurrent.ExecutionException;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class FailureTextTest {
    @Test
    void namesNoClass() {
        assertThat(FailureText.of(new ExecutionException(new IOException("Topic x not present"))))
                .isEqualTo("Topic x not present");
        assertThat(FailureText.of(new IllegalStateException(new ConnectException())))
                .isEqualTo("connection refused");
        ConnectException refused = new ConnectException(); // as the JDK's client has it
        refused.initCause(new ClosedChannelException());
        assertThat(FailureText.of(refused)).isEqualTo("connection refused");
        assertThat(FailureText.of(new ClosedChannelException())).isEqualTo("closed channel");
        assertThat(FailureText.of(new UnknownHostException("farm.lan"))).isEqualTo("there is no host of this name");
        assertThat(FailureText.of(new IOException("java.util.concurrent.TimeoutException: too late at farm.lan:9092")))
                .isEqualTo("too late at farm.lan:9092");
    }

    @Test
    void leavesOutTheStateOfADriver() {
        assertThat(
                        FailureText.of(
                                new IOException(
                                        "Timed out after 30000 ms while waiting to connect. Client view of cluster state is "
                                                + "{type=UNKNOWN, servers=[{exception={com.mongodb.MongoSocketOpenException: Exception opening socket}}]")))
                .isEqualTo("Timed out after 30000 ms while waiting to connect");
    }
}
