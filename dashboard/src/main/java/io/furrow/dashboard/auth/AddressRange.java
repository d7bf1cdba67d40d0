package io.furrow.dashboard.auth;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.regex.Pattern;

/**
 * An address, or a block of them in CIDR notation.
 *
 * @param first of the block
 * @param bits that all addresses of the block share
 */
public record AddressRange(InetAddress first, int bits) {
    /** No names: whoever has the name server would be believed. */
    private static final Pattern LITERAL = Pattern.compile("[0-9.]+|[0-9A-Fa-f:.]*:[0-9A-Fa-f:.]*");

    /** @throws IllegalArgumentException for what is none */
    public static AddressRange parse(String text) {
        String[] parts = text.strip().split("/", -1);
        try {
            if (parts.length <= 2 && LITERAL.matcher(parts[0]).matches()) {
                InetAddress first = InetAddress.getByName(parts[0]);
                int all = first.getAddress().length * Byte.SIZE;
                int bits = parts.length == 1 ? all : Integer.parseInt(parts[1]);
                if (bits >= 0 && bits <= all) {
                    return new AddressRange(first, bits);
                }
            }
        } catch (UnknownHostException | NumberFormatException e) {
            throw new IllegalArgumentException(none(text), e);
        }
        throw new IllegalArgumentException(none(text));
    }

    private static String none(String text) {
        return "'%s' is neither an address such as 10.0.0.7 nor a block such as 10.0.0.0/24".formatted(text);
    }

    boolean contains(InetAddress address) {
        byte[] own = first.getAddress();
        byte[] other = address.getAddress();
        if (own.length != other.length) {
            return false;
        }
        for (int bit = 0; bit < bits; bit++) {
            int mask = 0x80 >> bit % Byte.SIZE;
            if (((own[bit / Byte.SIZE] ^ other[bit / Byte.SIZE]) & mask) != 0) {
                return false;
            }
        }
        return true;
    }

    @Override
    public String toString() {
        return first.getHostAddress() + "/" + bits;
    }
}
