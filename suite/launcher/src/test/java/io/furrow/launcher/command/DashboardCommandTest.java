package io.furrow.launcher.command;

import java.io.PrintWriter;
import java.io.StringWriter;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

import io.furrow.launcher.Furrow;

import static org.assertj.core.api.Assertions.assertThat;

class DashboardCommandTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            --host=0.0.0.0                  | --host 0.0.0.0 lets other machines in: tokens would pass in the clear
            --readable-topics=data.*,a/b    | 'a/b' names no topics
            --writable-topics=a b           | 'a b' names no topics
            --control-plane=127.0.0.1:8085  | --control-plane
            --allowed-hosts=http://x        | --allowed-hosts
            --tiles=https://a.example/b.png | --tiles https://a.example/b.png names no tile: a URL has {z}, {x} and {y}
            --tiles=a.pmtiles --tiles=b.pmtiles | --tiles a.pmtiles, b.pmtiles: give one file only
            --sign-in-url=javascript:alert()  | --sign-in-url javascript:alert() is neither a path
            --sign-out-url=//a.example/out    | --sign-out-url //a.example/out is neither a path
            """)
    void rejectsWhatItCannotUseBeforeItListens(String options, String message) {
        StringWriter output = new StringWriter();
        CommandLine line = Furrow.commandLine();
        line.setErr(new PrintWriter(output));

        assertThat(line.execute(("dashboard " + options).split(" (?=--)"))).isEqualTo(2);
        assertThat(output.toString()).contains(message).doesNotContain("Exception");
    }
}
