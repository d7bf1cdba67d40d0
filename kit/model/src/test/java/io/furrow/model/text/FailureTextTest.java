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
    void containsNoClassNames() {
        assertThat(FailureText.of(new ExecutionException(new IOException("Topic x not present"))))
                .isEqualTo("Topic x not present");
        assertThat(FailureText.of(new IllegalStateException(new ConnectException())))
                .isEqualTo("connection refused");
        ConnectException refusedConnection = new ConnectException(); // as the JDK's client throws it
        refusedConnection.initCause(new ClosedChannelException());
        assertThat(FailureText.of(refusedConnection)).isEqualTo("connection refused");
        assertThat(FailureText.of(new ClosedChannelException())).isEqualTo("closed channel");
        assertThat(FailureText.of(new UnknownHostException("farm.lan"))).isEqualTo("there is no host of this name");
        assertThat(FailureText.of(new IOException("java.util.concurrent.TimeoutException: too late at farm.lan:9092")))
                .isEqualTo("too late at farm.lan:9092");
    }

    @Test
    void namesTheDeepestCauseOfAStackTrace() {
        String trace =
                "org.apache.kafka.connect.errors.ConnectException: Exiting WorkerSinkTask\n\tat org.apache.Some.run(Some.java:1)\n";
        assertThat(FailureText.ofTrace(trace)).isEqualTo("Exiting WorkerSinkTask");
        assertThat(
                        FailureText.ofTrace(
                                trace
                                        + "Caused by: io.furrow.connect.Outer: a\n\tat x\nCaused by: io.furrow.connect.Inner: the broker answers 401"))
                .isEqualTo("the broker answers 401");
        assertThat(FailureText.ofTrace("java.lang.NullPointerException\n\tat x"))
                .isEqualTo("null pointer");
        assertThat(FailureText.ofTrace("")).isEmpty();
    }

    @Test
    void omitsTheStateOfADriver() {
        assertThat(
                        FailureText.of(
                                new IOException(
                                        "Timed out after 30000 ms while waiting to connect. Client view of cluster state is "
                                                + "{type=UNKNOWN, servers=[{exception={com.mongodb.MongoSocketOpenException: Exception opening socket}}]")))
                .isEqualTo("Timed out after 30000 ms while waiting to connect");
    }
}
