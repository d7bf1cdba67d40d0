package io.furrow.bench.http;

import java.io.IOException;
import java.net.InetSocketAddress;
import java.net.StandardSocketOptions;
import java.nio.ByteBuffer;
import java.nio.channels.SelectionKey;
import java.nio.channels.Selector;
import java.nio.channels.SocketChannel;

/** Sends one request at a time over a connection that is reused, or opened for each. */
final class Exchange {
    private final InetSocketAddress target;
    private final Selector selector;
    private final NotificationRequest request;
    private final AnswerReader answer = new AnswerReader();
    private final boolean keep;

    private SocketChannel channel;
    private SelectionKey key;
    private ByteBuffer unwritten;
    private long number;
    private long dueNanos;

    Exchange(InetSocketAddress target, Selector selector, NotificationRequest request, boolean keep) {
        this.target = target;
        this.selector = selector;
        this.request = request;
        this.keep = keep;
    }

    /** The number of the last notification. */
    long number() {
        return number;
    }

    /** When it was due, which may be before it was sent. */
    long dueNanos() {
        return dueNanos;
    }

    void send(long numberToSend, long due) throws IOException {
        number = numberToSend;
        dueNanos = due;
        unwritten = request.with(number, System.currentTimeMillis());
        if (channel == null) {
            connect();
        } else {
            write();
        }
    }

    private void connect() throws IOException {
        channel = SocketChannel.open();
        channel.configureBlocking(false);
        channel.setOption(StandardSocketOptions.TCP_NODELAY, true);
        answer.reset();
        boolean connected = channel.connect(target);
        key = channel.register(selector, connected ? SelectionKey.OP_READ : SelectionKey.OP_CONNECT, this);
        if (connected) {
            write();
        }
    }

    /**
     * Proceeds as far as the selector allows.
     *
     * @return the status of the answer, or 0 if it is incomplete
     */
    int proceed() throws IOException {
        if (key.isConnectable()) {
            channel.finishConnect();
            write();
        } else if (key.isWritable()) {
            write();
        }
        if (!key.isReadable() || !answer.read(channel)) {
            return 0;
        }
        if (!keep || answer.isLast()) {
            close();
        }
        return answer.status();
    }

    private void write() throws IOException {
        channel.write(unwritten);
        int desired = unwritten.hasRemaining() ? SelectionKey.OP_WRITE : SelectionKey.OP_READ;
        if (key.interestOps() != desired) {
            key.interestOps(desired);
        }
    }

    void close() {
        try {
            if (channel != null) {
                channel.close();
            }
        } catch (IOException e) {
            throw new java.io.UncheckedIOException("cannot close a connection to " + target, e);
        } finally {
            channel = null;
        }
    }
}
