package io.furrow.model.device;

import java.io.IOException;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Reads and writes the file of a farm's secret. The first line is {@value #HEADER}, followed by a line for each key,
 * {@code key <number> <key>}, with {@code api-keys} for the one that derives API keys and {@code until <time>} for all
 * but the newest; empty lines and lines that begin with # are ignored. A file with another first line is a secret with
 * that line as its only key.
 */
public final class FarmSecretCodec {
    /** Shorter than the minimum of a secret, so that no version mistakes it for one. */
    static final String HEADER = "farm-secret 1";

    private static final Pattern HEADERS = Pattern.compile("farm-secret \\d{1,3}");
    private static final Pattern KEY =
            Pattern.compile("key\\s+([1-9]\\d{0,8})\\s+(\\S+)(\\s+api-keys)?(?:\\s+until\\s+(\\S+))?");
    /** Prefix of an encoded key, for keys with spaces in files of one line. */
    private static final String ENCODED = "base64:";

    private static final Pattern PLAIN = Pattern.compile("(?!base64:)[!-~]+");
    private static final String LINE_FORMAT =
            "'key <number> <key>', then 'api-keys' at one of them and 'until <time>' at older ones";

    private FarmSecretCodec() {}

    static FarmSecret read(Path file) throws IOException {
        try {
            return parse(Files.readAllLines(file));
        } catch (NoSuchFileException e) {
            throw new IOException(
                    "there is no file %s. The farm's secret is made once, with ./furrow secret new FILE, and every process of the farm has a copy of that file"
                            .formatted(file),
                    e);
        } catch (CharacterCodingException e) {
            throw new IOException(file + " is not text in UTF-8; is it the farm's secret?", e);
        } catch (IllegalArgumentException e) {
            throw new IOException(file + ": " + e.getMessage(), e);
        }
    }

    /** @throws IllegalArgumentException if a line is invalid; the message says which, why and what is expected */
    static FarmSecret parse(List<String> lines) {
        String first = lines.isEmpty() ? "" : lines.get(0).strip();
        if (!HEADERS.matcher(first).matches()) {
            FarmKey only = new FarmKey(1, first, null);
            return new FarmSecret(List.of(only), only);
        }
        if (!first.equals(HEADER)) {
            throw new IllegalArgumentException(
                    "'%s' is the form of a newer Furrow; this one reads '%s'".formatted(first, HEADER));
        }
        List<FarmKey> keys = new ArrayList<>();
        List<FarmKey> apiKeys = new ArrayList<>();
        for (int i = 1; i < lines.size(); i++) {
            String line = lines.get(i).strip();
            if (!line.isEmpty() && !line.startsWith("#")) {
                Matcher parts = KEY.matcher(line);
                FarmKey key = key(parts, i + 1);
                keys.add(key);
                if (parts.group(3) != null) {
                    apiKeys.add(key);
                }
            }
        }
        check(keys, apiKeys);
        return new FarmSecret(keys, apiKeys.get(0));
    }

    private static FarmKey key(Matcher parts, int line) {
        if (!parts.matches()) {
            throw new IllegalArgumentException("line %d: a line is %s".formatted(line, LINE_FORMAT));
        }
        try {
            Instant until = parts.group(4) == null ? null : Instant.parse(parts.group(4));
            return new FarmKey(Integer.parseInt(parts.group(1)), decode(parts.group(2)), until);
        } catch (DateTimeException e) {
            throw new IllegalArgumentException(
                    "line %d: '%s' is not a time such as 2026-03-01T08:00:00Z".formatted(line, parts.group(4)), e);
        } catch (IllegalArgumentException e) {
            throw new IllegalArgumentException("line %d: %s".formatted(line, e.getMessage()), e);
        }
    }

    private static String encode(String text) {
        return PLAIN.matcher(text).matches()
                ? text
                : ENCODED + Base64.getEncoder().encodeToString(text.getBytes(StandardCharsets.UTF_8));
    }

    private static String decode(String word) {
        return word.startsWith(ENCODED)
                ? new String(Base64.getDecoder().decode(word.substring(ENCODED.length())), StandardCharsets.UTF_8)
                : word;
    }

    private static void check(List<FarmKey> keys, List<FarmKey> apiKeys) {
        if (keys.stream().map(FarmKey::number).distinct().count() < keys.size()) {
            throw new IllegalArgumentException("two keys have one number; each has a number of its own");
        }
        if (apiKeys.size() != 1) {
            throw new IllegalArgumentException(
                    "%d lines have 'api-keys'; exactly one key makes API keys".formatted(apiKeys.size()));
        }
        int newest = keys.stream().mapToInt(FarmKey::number).max().orElse(0);
        for (FarmKey key : keys) {
            if ((key.until() == null) != (key.number() == newest)) {
                throw new IllegalArgumentException("key %d %s; each key but the newest has 'until <time>'"
                        .formatted(
                                key.number(),
                                key.until() == null ? "has no 'until'" : "is the newest and has 'until'"));
            }
        }
    }

    /** Returns the text of the file, the newest key first. */
    public static String write(FarmSecret secret) {
        StringBuilder text = new StringBuilder(HEADER).append('\n');
        text.append(
                "# Made by ./furrow secret. Whoever reads this file has the password of every device of the farm.\n");
        for (FarmKey key : secret.keys()) {
            text.append("key ").append(key.number()).append(' ').append(encode(key.text()));
            text.append(key.equals(secret.apiKeys()) ? " api-keys" : "");
            text.append(key.until() == null ? "" : " until " + key.until()).append('\n');
        }
        return text.toString();
    }
}
