package io.furrow.suite;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;

import io.furrow.files.Folders;

/** Finds words in the identifiers of a module's sources, including locals and parameters. */
final class SourceWords {
    /** Matches comments and literals so that they are skipped; identifiers and keywords remain. */
    private static final Pattern TOKEN = Pattern.compile(
            "/\\*(?>[^*]+|\\*(?!/))*+\\*/|//[^\\n]*+|\"\"\"(?:\\\\.|[^\"\\\\]|\"(?!\"\"))*+\"\"\"|\"(?:\\\\.|[^\"\\\\])*+\""
                    + "|'(?:\\\\.|[^'\\\\])*+'|[A-Za-z_]\\w*+",
            Pattern.DOTALL);

    private static final Pattern WORD = Pattern.compile("[A-Z]+(?![a-z])|[A-Z]?[a-z]+");

    private SourceWords() {}

    /** Maps identifiers that contain one of the words, in singular or plural, to their files. */
    static Map<String, Set<String>> identifiersWith(Set<String> words, Path module) throws IOException {
        Map<String, Set<String>> found = new TreeMap<>();
        Folders.walk(module.resolve("src")).stream()
                .filter(file -> file.toString().endsWith(".java"))
                .forEach(file -> TOKEN.matcher(text(file))
                        .results()
                        .map(MatchResult::group)
                        .filter(token -> Character.isLetter(token.charAt(0)) && has(words, token))
                        .forEach(token -> found.computeIfAbsent(token, each -> new TreeSet<>())
                                .add(file.getFileName().toString())));
        return found;
    }

    private static boolean has(Set<String> words, String identifier) {
        return WORD.matcher(identifier)
                .results()
                .map(each -> each.group().toLowerCase(Locale.ROOT))
                .anyMatch(word -> words.contains(word) || words.contains(word.replaceFirst("s$", "")));
    }

    private static String text(Path file) {
        try {
            return Files.readString(file);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + file, e);
        }
    }
}
