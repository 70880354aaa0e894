// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {pgmBytes, yamlText} from "./ros_map.js";
import {pdfBytes} from "./sheet_pdf.js";
import {makeSheet, sheetSvg, tilesPicture} from "./sheet.js";

const FORMATS = ["PNG", "SVG", "PDF", "PGM", "YAML"];
const CONTENTS = [["all", "As shown, with measures"], ["plan", "Plan: walls alone, with measures"]];

/// Buttons that hand the map to the browser as files.
export class SaveButtons {
  constructor(root, page) {
    this.page = page;
    this.content = document.createElement("select");
    this.content.id = "save-content";
    this.content.setAttribute("aria-label", "What SVG and PDF hold");
    this.content.append(...CONTENTS.map(([value, text]) => new Option(text, value)));
    root.append(this.content, ...FORMATS.map((format) => this.button(format)));
  }

  button(format) {
    const button = document.createElement("button");
    button.textContent = format;
    button.id = `save-${format.toLowerCase()}`;
    button.addEventListener("click", async () => offer(await this.file(format), `${this.name()}.${format.toLowerCase()}`));
    return button;
  }

  name() {
    return this.page.model.run.is_recording ? this.page.model.run.title.split("/").pop().replace(/\..*$/, "") : "map";
  }

  /// A Blob. PGM and YAML are those that swiftlet writes itself.
  async file(format) {
    const {model, tileMap, player} = this.page;
    switch (format) {
      case "PNG":
        return this.picture();
      case "PGM":
        return new Blob([pgmBytes(tileMap)], {type: "image/x-portable-graymap"});
      case "YAML":
        return new Blob([yamlText(tileMap, model.resolution_m, `${this.name()}.pgm`)], {type: "application/yaml"});
      default:
        return this.sheet(format, makeSheet(model, tileMap, this.page.layers, player.at_us, this.content.value === "plan"));
    }
  }

  async sheet(format, sheet) {
    const picture = sheet.image ? tilesPicture(this.page.tileMap, sheet.image.range) : null;
    if (format === "PDF") return new Blob([await pdfBytes(sheet, picture)], {type: "application/pdf"});
    return new Blob([sheetSvg(sheet, picture)], {type: "image/svg+xml"});
  }

  /// What the canvas shows.
  picture() {
    this.page.draw();
    return new Promise((resolve) => this.page.canvas.toBlob(resolve, "image/png"));
  }
}

function offer(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
