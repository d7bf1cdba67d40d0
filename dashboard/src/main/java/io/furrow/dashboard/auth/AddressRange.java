package io.furrow.dashboard.auth;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.regex.Pattern;

/**
 * An address, or a block of addresses in CIDR notation.
 *
 * @param first address of the block
 * @param bits length of the prefix
 */
public record AddressRange(InetAddress first, int bits) {
    /** Excludes host names: whoever controls the name server could claim any address. */
    private static final Pattern LITERAL = Pattern.compile("[0-9.]+|[0-9A-Fa-f:.]*:[0-9A-Fa-f:.]*");

    /** @throws IllegalArgumentException if the text is neither an address nor a block */
    public static AddressRange parse(String text) {
        String[] parts = text.strip().split("/", -1);
        try {
            if (parts.length <= 2 && LITERAL.matcher(parts[0]).matches()) {
                InetAddress first = InetAddress.getByName(parts[0]);
                int length = first.getAddress().length * Byte.SIZE;
                int bits = parts.length == 1 ? length : Integer.parseInt(parts[1]);
                if (bits >= 0 && bits <= length) {
                    return new AddressRange(first, bits);
                }
            }
        } catch (UnknownHostException | NumberFormatException e) {
            throw new IllegalArgumentException(message(text), e);
        }
        throw new IllegalArgumentException(message(text));
    }

    private static String message(String text) {
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
