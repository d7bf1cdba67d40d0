/** When devices were last heard of, how full their batteries are, and which of them are silent. */
package io.furrow.control.health;
