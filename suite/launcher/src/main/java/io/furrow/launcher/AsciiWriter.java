package io.furrow.launcher;

import java.io.BufferedWriter;
import java.io.FilterWriter;
import java.io.IOException;
import java.io.OutputStream;
import java.io.OutputStreamWriter;
import java.io.PrintWriter;
import java.io.Writer;
import java.nio.charset.Charset;
import java.util.Map;

/** Writes the signs of tables and sentences in ASCII, for terminals whose encoding lacks them, as with LC_ALL=C. */
final class AsciiWriter extends FilterWriter {
    private static final Map<Character, String> SIGNS =
            Map.of('…', "...", '–', "-", '−', "-", '→', "->", '←', "<-", '·', ".");

    private AsciiWriter(Writer out) {
        super(out);
    }

    /** A writer to a terminal or a pipe, in the encoding of this process. */
    static PrintWriter to(OutputStream out) {
        String platform =
                System.getProperty("native.encoding", Charset.defaultCharset().name());
        return to(out, Charset.forName(System.getProperty("stdout.encoding", platform)));
    }

    static PrintWriter to(OutputStream out, Charset encoding) {
        Writer writer = new BufferedWriter(new OutputStreamWriter(out, encoding));
        boolean lacksSigns =
                SIGNS.keySet().stream().anyMatch(sign -> !encoding.newEncoder().canEncode(sign));
        return new PrintWriter(lacksSigns ? new AsciiWriter(writer) : writer, true);
    }

    @Override
    public void write(int sign) throws IOException {
        String ascii = SIGNS.get((char) sign);
        if (ascii == null) {
            out.write(sign);
        } else {
            out.write(ascii);
        }
    }

    @Override
    public void write(char[] signs, int offset, int length) throws IOException {
        for (int i = offset; i < offset + length; i++) {
            write(signs[i]);
        }
    }

    @Override
    public void write(String text, int offset, int length) throws IOException {
        write(text.toCharArray(), offset, length);
    }
}
