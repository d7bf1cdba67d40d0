package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.FileChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.TreeMap;
import java.util.stream.Stream;

import io.furrow.connect.journal.Corruption.Kind;
import io.furrow.connect.journal.SegmentFormat.End;
import io.furrow.connect.journal.SegmentFormat.Header;

/**
 * Finds the segments of a journal and the end of each. Each segment stores the end of its predecessor, so only the last
 * file, and one whose successor is damaged, is read to its end; a corruption elsewhere is detected when it is read.
 */
record Recovery(Path folder, long salt, Corruptions damages) {
    /** A file, its length and its header if that is readable. */
    private record Candidate(long base, Path file, long length, Optional<Header> header) {}

    /** The segments in order. Unfinished files are deleted. */
    List<Segment> segments() throws IOException {
        List<Candidate> candidates = candidates();
        List<Segment> segments = new ArrayList<>();
        for (int i = 0; i < candidates.size(); i++) {
            Candidate candidate = candidates.get(i);
            Candidate next = i + 1 < candidates.size() ? candidates.get(i + 1) : null;
            End end = end(candidate, next);
            segments.add(Segment.found(candidate.base(), candidate.file(), candidate.length(), end));
            noteLength(candidate);
            if (next != null) {
                noteMissingBetween(candidate, end, next);
            }
        }
        return segments;
    }

    private End end(Candidate candidate, Candidate next) throws IOException {
        Optional<Header> said = next == null ? Optional.empty() : next.header();
        if (said.isPresent() && said.get().previous() == candidate.base()) {
            return said.get().previousEnd();
        }
        if (candidate.length() < SegmentFormat.HEADER) {
            return new End(SegmentFormat.HEADER, candidate.base());
        }
        try (RecordCursor cursor = new RecordCursor(candidate.file(), candidate.base(), salt, damages::note)) {
            return cursor.readToUnknownEnd();
        }
    }

    private void noteLength(Candidate candidate) {
        long length = candidate.length();
        if (candidate.header().isEmpty()) {
            damages.note(new Corruption(
                    candidate.base(), 0, Math.min(length, SegmentFormat.HEADER), candidate.base(), 0, Kind.CORRUPT));
        } else if (length < candidate.header().get().capacity()) {
            long made = candidate.header().get().capacity();
            damages.note(new Corruption(
                    candidate.base(), length, made, candidate.base(), Corruption.UNKNOWN, Kind.TRUNCATED));
        }
    }

    /** Between files, numbers may be skipped on purpose; the header records this. */
    private void noteMissingBetween(Candidate candidate, End end, Candidate next) {
        long expected =
                next.header().map(header -> header.previousEnd().sequence()).orElse(next.base());
        boolean follows = next.header()
                .map(header -> header.previous() == candidate.base())
                .orElse(false);
        if (!follows && expected > end.sequence()) {
            long missing = expected - end.sequence();
            damages.note(new Corruption(next.base(), 0, 0, end.sequence(), missing, Kind.MISSING));
        }
    }

    private List<Candidate> candidates() throws IOException {
        List<Path> files;
        try (Stream<Path> found = Files.list(folder)) {
            files = found.toList();
        }
        TreeMap<Long, Candidate> candidates = new TreeMap<>();
        for (Path file : files) {
            String name = file.getFileName().toString();
            Optional<Long> base = SegmentFormat.baseOf(name);
            if (base.isPresent()) {
                candidates.put(base.get(), candidate(base.get(), file));
            } else if (name.endsWith(".segment.tmp")) {
                Files.delete(file);
            }
        }
        return List.copyOf(candidates.values());
    }

    private Candidate candidate(long base, Path file) throws IOException {
        try (FileChannel channel = FileChannel.open(file, StandardOpenOption.READ)) {
            ByteBuffer bytes = ByteBuffer.allocate(SegmentFormat.HEADER);
            while (bytes.hasRemaining() && channel.read(bytes, bytes.position()) >= 0) {
                continue;
            }
            Optional<Header> header =
                    SegmentFormat.readHeader(bytes.flip(), salt).filter(read -> read.base() == base);
            return new Candidate(base, file, channel.size(), header);
        }
    }
}
