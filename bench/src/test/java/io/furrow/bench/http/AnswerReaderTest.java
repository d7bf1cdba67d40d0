package io.furrow.bench.http;

import java.io.EOFException;
import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.nio.channels.ServerSocketChannel;
import java.nio.channels.SocketChannel;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AnswerReaderTest {
    private final AnswerReader reader = new AnswerReader();

    @AutoClose
    private SocketChannel server;

    @AutoClose
    private SocketChannel client;

    @BeforeEach
    void connect() throws IOException {
        try (ServerSocketChannel listening = ServerSocketChannel.open()) {
            listening.bind(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0));
            client = SocketChannel.open(listening.getLocalAddress());
            server = listening.accept();
        }
    }

    @Test
    void readsAnswersOneAfterTheOther() throws IOException {
        answer("HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n");
        assertThat(reader.read(client)).isTrue();
        assertThat(reader.status()).isEqualTo(200);
        assertThat(reader.isLast()).isFalse();

        answer("HTTP/1.1 503 Service Unavailable\r\ncontent-length: 4\r\nCONNECTION: close\r\n\r\nfull");
        assertThat(reader.read(client)).isTrue();
        assertThat(reader.status()).isEqualTo(503);
        assertThat(reader.isLast()).isTrue();
    }

    @Test
    void waitsForTheWholeBody() throws IOException {
        answer("HTTP/1.1 400 Bad Request\r\nContent-Le");
        assertThat(reader.read(client)).isFalse();
        answer("ngth: 10\r\n\r\n12345");
        assertThat(reader.read(client)).isFalse();
        answer("67890");
        assertThat(reader.read(client)).isTrue();
        assertThat(reader.status()).isEqualTo(400);
    }

    @Test
    void takesAnAnswerWithoutLengthForOneWithoutBody() throws IOException {
        answer("HTTP/1.1 204 No Content\r\n\r\n");
        assertThat(reader.read(client)).isTrue();
        assertThat(reader.status()).isEqualTo(204);
    }

    @Test
    void saysThatTheServerClosedInsteadOfAnswering() throws IOException {
        answer("HTTP/1.1 200 OK\r\nContent-Length: 0\r\n");
        reader.read(client);
        server.close();
        assertThatThrownBy(() -> reader.read(client))
                .isInstanceOf(EOFException.class)
                .hasMessage("the connection was closed before the answer");
    }

    private void answer(String text) throws IOException {
        server.write(ByteBuffer.wrap(text.getBytes(US_ASCII)));
    }
}
