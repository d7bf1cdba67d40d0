package io.furrow.simulators.fiware;

import java.io.ByteArrayOutputStream;
import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.List;

/** The packets of MQTT 3.1.1 (OASIS standard, chapter 3) that a client needs who subscribes with QoS 1 and publishes with QoS 0. */
final class MqttPackets {
    static final int CONNACK = 2;
    static final int PUBLISH = 3;
    static final int SUBACK = 9;
    static final int UNSUBACK = 11;
    static final int PINGRESP = 13;

    private static final int MAX_BODY = 16 << 20;
    private static final int LEVEL_3_1_1 = 4;

    /** @param flags the lower half of the first byte */
    record Packet(int type, int flags, byte[] body) {}

    /** @param id 0 where nothing is to be acknowledged (QoS 0) */
    record Message(String topic, int id, byte[] payload) {}

    private interface Body {
        void write(DataOutputStream out) throws IOException;
    }

    private MqttPackets() {}

    /** @param first byte of the packet, which was read to wait for it */
    static Packet read(int first, DataInputStream in) throws IOException {
        int length = 0;
        for (int shift = 0; shift <= 21; shift += 7) {
            int digit = in.readUnsignedByte();
            length |= (digit & 0x7f) << shift;
            if (digit < 0x80) {
                break;
            }
        }
        if (length > MAX_BODY) {
            throw new IOException("an MQTT packet of " + length + " bytes, more than " + MAX_BODY);
        }
        byte[] body = new byte[length];
        in.readFully(body);
        return new Packet(first >> 4, first & 0x0f, body);
    }

    static Message message(Packet publish) {
        ByteBuffer body = ByteBuffer.wrap(publish.body());
        byte[] topic = new byte[body.getShort() & 0xffff];
        body.get(topic);
        boolean acknowledged = (publish.flags() & 0x06) != 0;
        int id = acknowledged ? body.getShort() & 0xffff : 0;
        byte[] payload = new byte[body.remaining()];
        body.get(payload);
        return new Message(new String(topic, StandardCharsets.UTF_8), id, payload);
    }

    /** A session that the broker keeps. User and password are null where it wants none. */
    static byte[] connect(String clientId, String user, String password, int keepAliveSeconds) {
        return packet(0x10, out -> {
            text(out, "MQTT");
            out.writeByte(LEVEL_3_1_1);
            out.writeByte((user == null ? 0 : 0x80) | (password == null ? 0 : 0x40));
            out.writeShort(keepAliveSeconds);
            text(out, clientId);
            if (user != null) {
                text(out, user);
            }
            if (password != null) {
                text(out, password);
            }
        });
    }

    static byte[] subscribe(int id, List<String> filters) {
        return packet(0x82, out -> {
            out.writeShort(id);
            for (String filter : filters) {
                text(out, filter);
                out.writeByte(1);
            }
        });
    }

    static byte[] unsubscribe(int id, List<String> filters) {
        return packet(0xa2, out -> {
            out.writeShort(id);
            for (String filter : filters) {
                text(out, filter);
            }
        });
    }

    static byte[] publish(String topic, byte[] payload) {
        return packet(0x30, out -> {
            text(out, topic);
            out.write(payload);
        });
    }

    static byte[] acknowledgement(int id) {
        return packet(0x40, out -> out.writeShort(id));
    }

    static byte[] ping() {
        return packet(0xc0, out -> {});
    }

    static byte[] disconnect() {
        return packet(0xe0, out -> {});
    }

    private static byte[] packet(int first, Body content) {
        ByteArrayOutputStream body = new ByteArrayOutputStream();
        ByteArrayOutputStream packet = new ByteArrayOutputStream();
        try {
            content.write(new DataOutputStream(body));
            packet.write(first);
            int rest = body.size();
            do {
                packet.write(rest > 0x7f ? rest & 0x7f | 0x80 : rest);
                rest >>= 7;
            } while (rest > 0);
            body.writeTo(packet);
        } catch (IOException e) {
            throw new UncheckedIOException("a packet could not be written into memory", e);
        }
        return packet.toByteArray();
    }

    private static void text(DataOutputStream out, String text) throws IOException {
        byte[] bytes = text.getBytes(StandardCharsets.UTF_8);
        out.writeShort(bytes.length);
        out.write(bytes);
    }
}
