/** What the Flink jobs share; two jobs never import each other, they meet in a topic. */
package io.furrow.flink;
